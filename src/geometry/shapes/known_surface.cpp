#include "geometry/shapes/known_surface.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "geometry/shapes/surface_points.hpp"
#include "geometry/thinning.hpp"

namespace credo {
namespace {

constexpr double kPoints = 400.0;

/// One point to a cell, whatever parts the surface is made of: a mesh of many small triangles has
/// points in each.
std::vector<Eigen::Vector3f> points_at(ObjectModel const& model, double spacing_m) {
  std::vector<Eigen::Vector3f> points;
  for (Eigen::Vector3d const& point : surface_points(model, spacing_m)) {
    points.push_back(point.cast<float>());
  }
  return thin_points(points, static_cast<float>(spacing_m));
}

KnownSurface surface_of(ObjectModel const& model) {
  auto shape = std::make_shared<ObjectShape const>(model);
  Eigen::AlignedBox3d const& bounds = shape->bounds();
  double const size_m = bounds.diagonal().norm();
  if (!(size_m > 0.0)) {
    throw std::logic_error("known_surfaces: " + model.name + " has no surface");
  }
  constexpr double kFirstTry = 20.0;
  double const coarse_m = size_m / kFirstTry;
  auto const count = static_cast<double>(points_at(model, coarse_m).size());
  // The number of points goes with the inverse square of their spacing.
  double const spacing_m = coarse_m * std::sqrt(count / kPoints);
  double const radius_m = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).norm();
  return {points_at(model, spacing_m), static_cast<float>(spacing_m), radius_m, std::move(shape),
          model.symmetry};
}

}  // namespace

KnownSurfaces known_surfaces(ObjectModels const& models) {
  KnownSurfaces surfaces;
  for (auto const& [name, model] : models) {
    surfaces.emplace(name, surface_of(model));
  }
  return surfaces;
}

}  // namespace credo
