#pragma once

#include <Eigen/Core>
#include <vector>

namespace credo {

/// 162 unit vectors all around, one within 11 degrees of any direction: the corners of an
/// icosahedron whose faces are twice cut in four.
[[nodiscard]] std::vector<Eigen::Vector3f> view_directions();

}  // namespace credo
