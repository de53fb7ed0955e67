#pragma once

#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"
#include "geometry/shapes/known_surface.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// Where a detector found an object.
struct FoundPose {
  PoseDistribution pose_world;
  /// As Detection has it.
  bool errors_repeat = true;
};

/// The pose of an object that is found once more. Of a detection whose errors repeat the part
/// `news` (novelty, existence.hpp) counts, nothing at 0, and no number of them takes away the
/// config's min_covariance_share. One whose error is drawn anew counts in full, always.
[[nodiscard]] PoseDistribution pose_after(PoseDistribution const& before, FoundPose const& found,
                                          double news, Symmetry const& symmetry,
                                          ObjectFusionConfig const& config);

/// Known objects that turn up elsewhere. A detection that the gate refused may be of an object that
/// has been moved: of the objects of its type that the frame did not show, the one that is believed
/// least. The place where it was found is kept beside the one where it is believed to be, as long
/// as every frame finds it there again, and gains as a found object gains. An object that was
/// looked for in vain is there once that is the likelier place; one that is hidden or out of view
/// needs a second of it, for there is one of each known object and no more. Its id stays; its pose
/// and probability are those of the other place.
[[nodiscard]] std::vector<ObjectBelief> moved_objects(std::vector<ObjectBelief> objects,
                                                      Segmentation const& segmentation,
                                                      KnownSurfaces const& surfaces,
                                                      FusionConfig const& config);

}  // namespace credo
