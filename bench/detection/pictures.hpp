#pragma once

#include <vector>

#include "core/detection.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/outline.hpp"
#include "eval/detection_scorer.hpp"
#include "views.hpp"

namespace credo {

/// The depth shaded by its slope, the true objects' outlines in green, those of detections in
/// yellow where they are right to the widest tier and in red where not.
[[nodiscard]] Grid<Rgb> picture_of(TableView const& view, std::vector<Detection> const& detections,
                                   DetectionScorer::Matches const& matches,
                                   Outlines const& outlines);

}  // namespace credo
