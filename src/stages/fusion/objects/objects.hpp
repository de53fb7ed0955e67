#pragma once

#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"
#include "stages/fusion/existence.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// Known objects after one more frame (thesis 4.1, algorithm 4). One that was seen has its pose
/// updated by the detected one and is the likelier to be there; one that was looked for in vain
/// keeps its pose and is the less likely. Where nobody looked, neither moves. Observations of
/// objects that are not there are passed over.
///
/// A detector repeats its errors from frame to frame as long as the picture stays the same. So of a
/// detection the part that is news since the object was last seen (novelty, existence.hpp) counts,
/// and no number of looks takes away its min_covariance_share, unless the detector says that it
/// draws its errors anew (pose_after, places.hpp). What was looked for in vain until it
/// is not believed to be there any more may have been moved: its covariance goes back towards the
/// prior's, so that it is found again within what was told.
[[nodiscard]] std::vector<ObjectBelief> fused_objects(std::vector<ObjectBelief> objects,
                                                      Segmentation const& segmentation,
                                                      ViewChange const& change,
                                                      KnownSurfaces const& surfaces,
                                                      FusionConfig const& config);

}  // namespace credo
