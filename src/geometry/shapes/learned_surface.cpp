#include "geometry/shapes/learned_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/shapes/surface_nets.hpp"

namespace credo {
namespace {

constexpr float kFinestSpacing_m = 0.003F;
constexpr float kMostSpacings = 120.0F;
constexpr float kSpacing_pitches = 1.5F;
constexpr float kNormalRadius_spacings = 2.5F;

}  // namespace

LearnedSurface learned_surface(std::vector<SeenPoints> const& views) {
  LearnedSurface learned;
  Eigen::AlignedBox3f bounds;
  for (SeenPoints const& view : views) {
    learned.points += view.points.size();
    for (Eigen::Vector3f const& point : view.points) {
      bounds.extend(point);
    }
  }
  if (learned.points == 0) {
    return learned;
  }
  learned.spacing_m = std::max({kFinestSpacing_m, bounds.sizes().maxCoeff() / kMostSpacings,
                                kSpacing_pitches * typical_pitch_m(views)});
  std::vector<OrientedPoint> const oriented =
      with_normals(views, kNormalRadius_spacings * learned.spacing_m);
  learned.used_points = oriented.size();
  learned.mesh = surface_through(oriented, learned.spacing_m);
  return learned;
}

}  // namespace credo
