#include "sim/height_field.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/cloud.hpp"

namespace credo {
namespace {

struct Raster {
  Eigen::Vector3d first_m;
  Footprint footprint;

  void take(Pixel cell, double height_m) {
    if (!footprint.low_m.contains(cell)) {
      return;
    }
    auto const height = static_cast<float>(height_m);
    float& low = footprint.low_m[cell];
    float& high = footprint.high_m[cell];
    low = low <= height ? low : height;  // NaN gives way
    high = high >= height ? high : height;
  }

  /// The triangle's height at the middles of the cells that it covers, and at its corners.
  void draw(std::array<Eigen::Vector3d, 3> corners) {
    Eigen::AlignedBox2d box;
    for (Eigen::Vector3d& corner : corners) {
      corner -= first_m;
      corner.head<2>() /= kHeightCell_m;
      box.extend(corner.head<2>());
      take({static_cast<int>(std::lround(corner.x())), static_cast<int>(std::lround(corner.y()))},
           corner.z());
    }
    Eigen::Matrix2d sides;
    sides << corners[1].head<2>() - corners[0].head<2>(),
        corners[2].head<2>() - corners[0].head<2>();
    if (std::abs(sides.determinant()) < 1e-9) {
      return;  // seen from its edge
    }
    Eigen::Matrix2d const inverse = sides.inverse();
    for (int v = static_cast<int>(std::ceil(box.min().y())); v <= box.max().y(); ++v) {
      for (int u = static_cast<int>(std::ceil(box.min().x())); u <= box.max().x(); ++u) {
        Eigen::Vector2d const share = inverse * (Eigen::Vector2d(u, v) - corners[0].head<2>());
        if (share.minCoeff() >= -1e-9 && share.sum() <= 1.0 + 1e-9) {
          take({u, v}, corners[0].z() + share.x() * (corners[1].z() - corners[0].z()) +
                           share.y() * (corners[2].z() - corners[0].z()));
        }
      }
    }
  }
};

/// The least of each cell and its eight neighbours.
Grid<float> spread_low(Grid<float> const& low_m) {
  Grid<float> spread = low_m;
  for (int v = 0; v < low_m.height(); ++v) {
    for (int u = 0; u < low_m.width(); ++u) {
      for (int k = 0; k < 9; ++k) {
        Pixel const beside{u + k % 3 - 1, v + k / 3 - 1};
        if (low_m.contains(beside) && !(spread[{u, v}] <= low_m[beside]) &&
            !std::isnan(low_m[beside])) {
          spread[{u, v}] = low_m[beside];
        }
      }
    }
  }
  return spread;
}

}  // namespace

Footprint footprint_of(TriangleMesh const& mesh) {
  Eigen::AlignedBox3d box;
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    box.extend(vertex.cast<double>());
  }
  // Two empty cells all around.
  Eigen::Vector3d const margin(2.0 * kHeightCell_m, 2.0 * kHeightCell_m, 0.0);
  Raster raster{box.min() - margin, {}};
  Eigen::Vector2d const cells = (box.sizes() + 2.0 * margin).head<2>() / kHeightCell_m;
  int const width = 1 + static_cast<int>(std::ceil(cells.x()));
  int const depth = 1 + static_cast<int>(std::ceil(cells.y()));
  raster.footprint.low_m = Grid<float>(width, depth, kNaN);
  raster.footprint.high_m = raster.footprint.low_m;
  for (auto const& [a, b, c] : mesh.triangles) {
    raster.draw({mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
                 mesh.vertices[c].cast<double>()});
  }
  raster.footprint.low_m = spread_low(raster.footprint.low_m);
  raster.footprint.origin_m = -raster.first_m;
  return raster.footprint;
}

std::optional<Drop> HeightField::drop(Footprint const& body, Pixel cell) const {
  Pixel const last{cell.u + body.low_m.width() - 1, cell.v + body.low_m.height() - 1};
  if (!heights_m_.contains(cell) || !heights_m_.contains(last)) {
    return std::nullopt;
  }
  float up_m = 0.0F;
  for (int v = 0; v < body.low_m.height(); ++v) {
    for (int u = 0; u < body.low_m.width(); ++u) {
      // std::max keeps its first where the second is NaN.
      up_m = std::max(up_m, heights_m_[{cell.u + u, cell.v + v}] - body.low_m[{u, v}]);
    }
  }
  return Drop{cell, up_m};
}

std::vector<Eigen::Vector2d> HeightField::contacts(Footprint const& body, Drop const& drop,
                                                   double tolerance_m) const {
  std::vector<Eigen::Vector2d> touching;
  for (int v = 0; v < body.low_m.height(); ++v) {
    for (int u = 0; u < body.low_m.width(); ++u) {
      Pixel const there{drop.cell.u + u, drop.cell.v + v};
      if (drop.height_m + body.low_m[{u, v}] - heights_m_[there] < tolerance_m) {
        touching.emplace_back(there.u * kHeightCell_m, there.v * kHeightCell_m);
      }
    }
  }
  return touching;
}

void HeightField::add(Footprint const& body, Drop const& drop) {
  for (int v = 0; v < body.high_m.height(); ++v) {
    for (int u = 0; u < body.high_m.width(); ++u) {
      float& height = heights_m_[{drop.cell.u + u, drop.cell.v + v}];
      height = std::max(height, static_cast<float>(drop.height_m) + body.high_m[{u, v}]);
    }
  }
}

}  // namespace credo
