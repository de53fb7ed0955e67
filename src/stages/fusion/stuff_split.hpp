#pragma once

#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "stages/fusion/stuff_looks.hpp"

namespace credo {

/// A thing's model without what showed to be things of their own, and the clusters that are these.
struct SplitModel {
  StuffModel model;
  std::vector<LabelCode> parts;
};

/// What shows look after look as a cluster beside the thing's largest one is a thing of its own.
/// The thing was found in the clusters `labels`, of which `largest` is the largest; `news` is how
/// much of the look counts (novelty). The look must be at this model, with all its points.
[[nodiscard]] SplitModel split_model(StuffModel model, StuffLook const& look, LabelMap const& shown,
                                     LabelCode largest, std::span<LabelCode const> labels,
                                     double news);

}  // namespace credo
