#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace credo {

/// Positions of points, by the cube that each lies in.
class PointCells {
public:
  explicit PointCells(float cell_m) : per_m_(1.0F / cell_m) {}

  void add(Eigen::Vector3f const& point, std::uint32_t position) {
    cells_[key(cell_of(point))].push_back(position);
  }
  /// Of all points in the cube of a point and those around it: none within a cube's edge is missed.
  template <typename Visit>
  void around(Eigen::Vector3f const& point, Visit const& visit) const {
    Eigen::Vector3i const centre = cell_of(point);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          auto const found = cells_.find(key(centre + Eigen::Vector3i(x, y, z)));
          if (found != cells_.end()) {
            for (std::uint32_t const position : found->second) {
              visit(position);
            }
          }
        }
      }
    }
  }

private:
  [[nodiscard]] Eigen::Vector3i cell_of(Eigen::Vector3f const& point) const {
    return (point * per_m_).array().floor().cast<int>();
  }
  static std::uint64_t key(Eigen::Vector3i const& cell) {
    constexpr std::uint64_t kBits = 21;
    constexpr std::uint64_t kMask = (1ULL << kBits) - 1;
    return ((static_cast<std::uint64_t>(cell.x()) & kMask) << (2 * kBits)) |
           ((static_cast<std::uint64_t>(cell.y()) & kMask) << kBits) |
           (static_cast<std::uint64_t>(cell.z()) & kMask);
  }

  float per_m_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace credo
