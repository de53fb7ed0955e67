#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/cloud.hpp"

namespace credo::test {

/// Between two unit vectors, in degrees.
inline float angle_deg(Eigen::Vector3f const& a, Eigen::Vector3f const& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 57.29578F;
}

/// The value that a share of all values does not exceed; 0 for no values.
inline float quantile(std::vector<float> values, double share) {
  if (values.empty()) {
    return 0.0F;
  }
  auto const rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// The share of all values that are not above a limit; 1 for no values.
inline double share_within(std::vector<float> const& values, float limit) {
  auto const within = std::ranges::count_if(values, [&](float x) { return x <= limit; });
  return values.empty() ? 1.0 : static_cast<double>(within) / static_cast<double>(values.size());
}

/// Whether depth jumps or is missing within `reach` pixels in either direction.
inline bool beside_edge(Grid<float> const& depth_m, Pixel p, int reach) {
  float const z = depth_m[p];
  for (int v = p.v - reach; v <= p.v + reach; ++v) {
    for (int u = p.u - reach; u <= p.u + reach; ++u) {
      Pixel const q{u, v};
      // NaN is beside an edge too.
      if (depth_m.contains(q) && !(std::abs(depth_m[q] - z) <= 0.03F + 0.02F * z * z)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace credo::test
