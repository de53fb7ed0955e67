#include "stages/planes/remaining_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stages/planes/small_shots.hpp"

namespace credo::test {
namespace {

/// A floor and boxes in front of each other, with every fifth normal turned.
Shot boxes() {
  WorldScene scene = WorldScene().with_floor().with_box({-2.0, 3.0, 0.0}, {2.0, 3.1, 2.0});
  scene.with_box({-1.0, 2.0, 0.0}, {-0.2, 2.6, 1.0}).with_box({0.2, 1.8, 0.0}, {1.0, 2.02, 0.8});
  Shot shot = shot_of(scene, camera_looking_along_y(1.3, 0.5));
  std::mt19937 random(1);
  for (std::size_t i = 0; i < shot.normals.size(); ++i) {
    if (shot.normals.valid(i) && random() % 5 == 0) {
      shot.normals.set(i, Eigen::Vector3f(0.6F, 0.0F, -0.8F));
    }
  }
  return shot;
}

/// What lies in the plane by distance and is none of it.
PixelSet left_beside(PlaneView const& view, PixelPlane const& plane, PixelSet const& all) {
  PlaneTolerance by_distance = view.tolerance;
  by_distance.min_cosine = 0.0F;
  PixelSet left = inliers_among(view, plane.camera, all, by_distance).pixels;
  left.remove(plane.inliers.pixels);
  left.remove(plane.joined.pixels);
  return left;
}

std::size_t count_of(PixelSet const& pixels) {
  std::size_t count = 0;
  pixels.for_each([&](std::size_t /*pixel*/) { ++count; });
  return count;
}

// Only that is asked again, once all planes are found: what a plane had to leave out for its
// normals, for another plane that had it, or because it held hardly any of its segment.
TEST(RemainingPoints, KnowAllThatLiesInAPlaneAndIsNotItsOwn) {
  Shot const shot = boxes();
  PlanesConfig const config = small_planes();
  std::size_t open_alone = 0;
  std::size_t given_back = 0;
  // Segments across all that stands there: stripes, and the floor in squares.
  for (double const size_m : {0.3, 0.9}) {
    Segments const segments = segments_of(shot, [&](Eigen::Vector3d const& p) {
      return 1 + static_cast<std::int32_t>(std::abs(std::floor(p.x() / size_m)) +
                                           std::abs(std::floor(p.z() / size_m))) %
                     8;
    });
    PlaneView const view = plane_view_of(shot, segments, config);
    RemainingPoints remaining(view, segments, view.valid);
    for (Plane const& suggested : remaining.suggested()) {
      std::optional<PixelPlane> plane = remaining.take(suggested);
      if (!plane) {
        continue;
      }
      std::size_t const taken = plane->inliers.count;
      remaining.settle(*plane);
      given_back += taken - plane->inliers.count;
      PixelSet unknown = left_beside(view, *plane, view.valid.pixels);
      unknown.remove(plane->turned);
      open_alone += count_of(unknown);
      unknown.remove(plane->open);
      EXPECT_EQ(count_of(unknown), 0U);
    }
  }
  EXPECT_GT(open_alone, 100U);
  EXPECT_GT(given_back, 0U);
}

}  // namespace
}  // namespace credo::test
