#pragma once

#include <vector>

#include "core/detection.hpp"
#include "core/frame.hpp"
#include "detector/models/prepared_model.hpp"

namespace credo {

/// What the camera sees, in colour where that is registered to depth, else depth as grey; over it
/// each detected model at its mean pose, tinted where it stands before the scene, with its
/// silhouette. Types without a model are left out. A frame without pixels gives an empty picture.
[[nodiscard]] Grid<Rgb> draw_detections(Frame const& frame, PreparedModels const& models,
                                        std::vector<Detection> const& detections);

}  // namespace credo
