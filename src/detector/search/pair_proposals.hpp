#pragma once

#include <cstdint>
#include <vector>

#include "detector/models/pair_table.hpp"
#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/poses/verification.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// A pose that something in the scene speaks for.
struct Proposal {
  CameraPose pose;
  /// Of the piece of the frame that it came from.
  std::uint16_t segment = 0;
};

/// Poses of a model by voting of point pairs (Drost et al. 2010): each of some points of the scene
/// votes, with all points around it, for a point of the model and a turn about its normal. Points
/// on planes larger than the model are left out, segments larger than it, and what is `explained`
/// already (empty, or as large as the image); where something is, twice as many of the others vote.
/// In the order of the segments.
[[nodiscard]] std::vector<Proposal> propose_by_pairs(SearchModel const& model,
                                                     PairTable const& pairs,
                                                     SearchScene const& scene,
                                                     ClaimedPixels const& explained);

}  // namespace credo
