#pragma once

#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "stages/fusion/stuff/looks.hpp"

namespace credo {

/// Counts in SurfacePoint::missed where one sees through the thing, which was found in the clusters
/// `labels`: less where it is the thing itself that is seen behind, and back where it agrees.
void count_misses(StuffModel& model, StuffLook const& look, LabelMap const& shown,
                  std::span<LabelCode const> labels, double news);

/// A thing's model without what showed to be another's, and the clusters that are things of their
/// own.
struct SplitModel {
  StuffModel model;
  std::vector<LabelCode> parts;
};

/// What shows look after look as a cluster beside the thing's main one is a thing of its own; not
/// where the model goes on from one to the other behind something else: that cuts them apart.
/// Single points that show as floor, wall, known object or in others' clusters go, the sooner the
/// fewer looks they come from.
/// The thing was found in the clusters `labels`, of which `main` shows most of what was seen of
/// it; `news` is how much of the look counts (novelty). The look must be at this model, with all
/// its points.
[[nodiscard]] SplitModel split_model(StuffModel model, StuffLook const& look, LabelMap const& shown,
                                     LabelCode main, std::span<LabelCode const> labels,
                                     double news);

}  // namespace credo
