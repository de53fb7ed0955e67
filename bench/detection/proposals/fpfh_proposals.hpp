#pragma once

#include <vector>

#include "described_points.hpp"
#include "detector/search/pair_proposals.hpp"

namespace credo {

/// Poses of a model as the thesis proposes them (its first round): random points of the scene, each
/// with the model's features that are nearest to its own, drawn by how near they are; one such
/// match, with normals and directions of bending, is a pose, and another with the sign of the
/// bending turned. Left out as in propose_by_pairs: planes larger than the model, segments larger
/// than it, and what is `explained`. The same for the same input.
[[nodiscard]] std::vector<Proposal> propose_by_fpfh(
    SearchModel const& model, DescribedPoints const& of_model, SearchScene const& scene,
    DescribedPoints const& of_scene, ClaimedPixels const& explained, FpfhSettings const& settings);

}  // namespace credo
