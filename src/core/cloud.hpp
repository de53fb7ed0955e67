#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/grid.hpp"

namespace credo {

inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// One 3-vector per pixel as three grids of equal size, so that kernels vectorise. A pixel is
/// invalid where any of its components is NaN; by contract all three are then NaN.
struct VectorGrid {
  Grid<float> x, y, z;

  VectorGrid() = default;
  /// All pixels invalid.
  VectorGrid(int width, int height)
      : x(width, height, kNaN), y(width, height, kNaN), z(width, height, kNaN) {}

  /// See Grid::unset().
  [[nodiscard]] static VectorGrid unset(int width, int height) {
    VectorGrid grid;
    grid.x = Grid<float>::unset(width, height);
    grid.y = Grid<float>::unset(width, height);
    grid.z = Grid<float>::unset(width, height);
    return grid;
  }

  [[nodiscard]] int width() const { return x.width(); }
  [[nodiscard]] int height() const { return x.height(); }
  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] bool empty() const { return x.empty(); }
  [[nodiscard]] bool valid(std::size_t i) const { return !std::isnan(x[i] + y[i] + z[i]); }
  [[nodiscard]] Eigen::Vector3f at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  [[nodiscard]] Eigen::Vector3f at(Pixel p) const { return at(x.index(p)); }
  void set(std::size_t i, Eigen::Vector3f const& value) {
    x[i] = value.x();
    y[i] = value.y();
    z[i] = value.z();
  }
};

/// The points of a frame in metres, in the camera's optical frame (x right, y down, z forward).
/// `z` is the depth image. Depth is positive where valid.
struct OrganizedCloud : VectorGrid {
  using VectorGrid::VectorGrid;
};

/// Unit normals in the camera's optical frame, facing the camera (n . p <= 0); NaN where the
/// neighbourhood does not carry one.
struct NormalMap : VectorGrid {
  using VectorGrid::VectorGrid;
  explicit NormalMap(VectorGrid grid) : VectorGrid(std::move(grid)) {}
};

}  // namespace credo
