#pragma once

#include "model_cloud.hpp"
#include "refinement.hpp"

namespace credo {

/// The first point in each cell of a grid.
[[nodiscard]] NormalCloud::Ptr thinned(NormalCloud const& points, double cell_m);

/// A pose made better by ICP, twice: from the scene's points that are nearer to the model's surface
/// than 2 cm, then than 1 cm, to the model.
[[nodiscard]] Eigen::Isometry3f fitted(SearchedCloud const& model,
                                       Eigen::Isometry3f const& pose_camera,
                                       NormalCloud const& scene);

}  // namespace credo
