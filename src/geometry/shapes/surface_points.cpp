#include "geometry/shapes/surface_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <stdexcept>
#include <variant>

#include "geometry/shapes/solid_distance.hpp"

namespace credo {
namespace {

using Points = std::vector<Eigen::Vector3d>;

int steps(double length_m, double spacing_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / spacing_m - 1e-9)));
}

void add_points(BoxSolid const& box, double spacing_m, Points& points) {
  Eigen::Vector3d const size = box.high_m - box.low_m;
  Eigen::Vector3i const n(steps(size.x(), spacing_m), steps(size.y(), spacing_m),
                          steps(size.z(), spacing_m));
  for (int x = 0; x <= n.x(); ++x) {
    for (int y = 0; y <= n.y(); ++y) {
      bool const side = x == 0 || x == n.x() || y == 0 || y == n.y();
      // Within the outline only the lower and the upper face.
      for (int z = 0; z <= n.z(); z += side ? 1 : n.z()) {
        Eigen::Vector3d const share(static_cast<double>(x) / n.x(), static_cast<double>(y) / n.y(),
                                    static_cast<double>(z) / n.z());
        points.emplace_back(box.low_m + size.cwiseProduct(share));
      }
    }
  }
}

void add_ring(double radius_m, double z_m, double spacing_m, Points& points) {
  int const n =
      radius_m > 0.0 ? std::max(6, steps(2.0 * std::numbers::pi * radius_m, spacing_m)) : 1;
  for (int i = 0; i < n; ++i) {
    double const angle = 2.0 * std::numbers::pi * i / n;
    points.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), z_m);
  }
}

void add_points(CylinderSolid const& cylinder, double spacing_m, Points& points) {
  int const rings = steps(cylinder.radius_m, spacing_m);
  for (int i = 0; i < rings; ++i) {
    double const radius_m = cylinder.radius_m * i / rings;
    add_ring(radius_m, 0.0, spacing_m, points);
    add_ring(radius_m, cylinder.height_m, spacing_m, points);
  }
  int const levels = steps(cylinder.height_m, spacing_m);
  for (int i = 0; i <= levels; ++i) {
    add_ring(cylinder.radius_m, cylinder.height_m * i / levels, spacing_m, points);
  }
}

void add_points(SphereSolid const& sphere, double spacing_m, Points& points) {
  int const rings = std::max(3, steps(std::numbers::pi * sphere.radius_m, spacing_m));
  for (int i = 0; i <= rings; ++i) {
    double const angle = std::numbers::pi * i / rings;
    bool const pole = i == 0 || i == rings;
    add_ring(pole ? 0.0 : sphere.radius_m * std::sin(angle),
             sphere.radius_m * (1.0 - std::cos(angle)), spacing_m, points);
  }
}

void add_points(TriangleMesh const& mesh, double spacing_m, Points& points) {
  for (auto const& triangle : mesh.triangles) {
    Eigen::Vector3d const a = mesh.vertices[triangle[0]].cast<double>();
    Eigen::Vector3d const ab = mesh.vertices[triangle[1]].cast<double>() - a;
    Eigen::Vector3d const ac = mesh.vertices[triangle[2]].cast<double>() - a;
    int const n = steps(std::max({ab.norm(), ac.norm(), (ac - ab).norm()}), spacing_m);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        points.emplace_back(a + ab * (static_cast<double>(i) / n) +
                            ac * (static_cast<double>(j) / n));
      }
    }
  }
}

/// The first point in each cell of a grid: small triangles bring many in one place.
Points thinned(Points const& points, double cell_m) {
  std::set<std::array<std::int64_t, 3>> taken;
  Points kept;
  for (Eigen::Vector3d const& point : points) {
    Eigen::Vector3d const cell = (point / cell_m).array().floor();
    if (taken.insert({std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())})
            .second) {
      kept.push_back(point);
    }
  }
  return kept;
}

bool is_inside(Solid const& solid, Eigen::Vector3d const& point) {
  return distance_to(solid, point).distance_m < -1e-9;
}

Points points_of(std::vector<Solid> const& solids, double spacing_m) {
  Points points;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    Points own;
    std::visit([&](auto const& solid) { add_points(solid, spacing_m, own); }, solids[i]);
    for (Eigen::Vector3d const& point : own) {
      bool hidden = false;
      for (std::size_t j = 0; j < solids.size() && !hidden; ++j) {
        hidden = j != i && is_inside(solids[j], point);
      }
      if (!hidden) {
        points.push_back(point);
      }
    }
  }
  return points;
}

}  // namespace

std::vector<Eigen::Vector3d> surface_points(ObjectModel const& model, double spacing_m) {
  if (!(spacing_m > 0.0)) {
    throw std::logic_error("surface_points: spacing must be positive");
  }
  if (auto const* solids = std::get_if<std::vector<Solid>>(&model.shape)) {
    return points_of(*solids, spacing_m);
  }
  Points points;
  add_points(std::get<TriangleMesh>(model.shape), spacing_m, points);
  return thinned(points, spacing_m);
}

}  // namespace credo
