// What makes an upright plane a wall, with the default numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stages/planes/planes.hpp"
#include "stages/planes/small_shots.hpp"

namespace credo::test {
namespace {

/// Whether a wall is found at y = 2, from 1.3 m above the floor: the view is 2.2 m wide there, and
/// reaches from 0.5 m to 2.1 m.
bool is_wall_at_two_metres(WorldScene const& scene) {
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.0));
  Segmentation const result =
      extract_planes(shot.frame, shot.normals, shot.unassigned(), small_planes());
  return std::ranges::any_of(result.walls, [](WallObservation const& wall) {
    return std::abs(wall.plane_world.offset_m + 2.0) < 0.02;
  });
}

/// The next room's wall, far behind.
WorldScene far_wall() {
  return WorldScene().with_floor().with_wall(5.0);
}

TEST(Walls, MayHaveADoorway) {
  EXPECT_TRUE(is_wall_at_two_metres(far_wall()
                                        .with_box({-3.0, 2.0, 0.0}, {-0.3, 2.1, 2.6})
                                        .with_box({0.3, 2.0, 0.0}, {3.0, 2.1, 2.6})));
}

TEST(Walls, MayEndAtACorner) {
  EXPECT_TRUE(is_wall_at_two_metres(far_wall().with_box({-3.0, 2.0, 0.0}, {0.3, 2.1, 2.6})));
}

TEST(Walls, AreLongWhereTheyEndAtACorner) {
  EXPECT_FALSE(is_wall_at_two_metres(far_wall().with_box({-3.0, 2.0, 0.0}, {-0.6, 2.1, 2.6})));
}

TEST(Walls, AreNotWhatEndsOnBothSides) {
  EXPECT_FALSE(is_wall_at_two_metres(far_wall().with_box({-0.6, 2.0, 0.0}, {0.6, 2.5, 2.6})));
}

TEST(Walls, AreNotPillarsInOnePlane) {
  EXPECT_FALSE(is_wall_at_two_metres(far_wall()
                                         .with_box({-2.0, 2.0, 0.0}, {-0.9, 2.3, 2.6})
                                         .with_box({0.9, 2.0, 0.0}, {2.0, 2.3, 2.6})));
}

TEST(Walls, AreNotWhatStandsBeforeAWall) {
  WorldScene scene = WorldScene().with_floor().with_wall(2.6);
  EXPECT_FALSE(is_wall_at_two_metres(scene.with_box({-3.0, 2.0, 0.0}, {0.3, 2.6, 2.6})));
}

TEST(Walls, AreNotWhatOneLooksOver) {
  EXPECT_FALSE(is_wall_at_two_metres(far_wall().with_box({-3.0, 2.0, 0.0}, {3.0, 2.1, 1.6})));
}

TEST(Walls, AreNotWhatHangsThere) {
  EXPECT_FALSE(is_wall_at_two_metres(far_wall().with_box({-3.0, 2.0, 1.0}, {3.0, 2.1, 2.6})));
}

TEST(Walls, AreNotWhatOneLooksThrough) {
  WorldScene rack = far_wall();
  for (double x_m = -1.2; x_m < 1.2; x_m += 0.3) {
    rack.with_box({x_m, 2.0, 0.0}, {x_m + 0.15, 2.1, 2.6});
  }
  EXPECT_FALSE(is_wall_at_two_metres(rack));
}

TEST(Walls, AreFoundHoweverTheCameraIsTurned) {
  // Turned on its side, a corner is above or below in the picture.
  Se3 const on_its_side(so3_exp({0.0, M_PI / 2.0, 0.0}), {0.0, 0.0, 1.3});
  Shot const shot = shot_of(far_wall().with_box({-3.0, 2.0, 0.0}, {0.3, 2.1, 2.6}),
                            on_its_side * camera_looking_along_y(0.0, 0.0));
  Segmentation const result =
      extract_planes(shot.frame, shot.normals, shot.unassigned(), small_planes());
  EXPECT_TRUE(std::ranges::any_of(result.walls, [](WallObservation const& wall) {
    return std::abs(wall.plane_world.offset_m + 2.0) < 0.02;
  }));
}

/// The same where what lies at y = 2 is a segment, and what is behind it and before it are others;
/// so many points are a sample.
bool is_wall_of_segments(WorldScene const& scene, int sample_points) {
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.0));
  Segmentation unassigned = shot.unassigned();
  unassigned.segments = segments_of(shot, [](Eigen::Vector3d const& p_m) {
    return p_m.y() < 1.99 ? 1 : p_m.y() < 2.01 ? 2 : 3;
  });
  PlanesConfig config = small_planes();
  config.sample_points = sample_points;
  Segmentation const result = extract_planes(shot.frame, shot.normals, unassigned, config);
  return std::ranges::any_of(result.walls, [](WallObservation const& wall) {
    return std::abs(wall.plane_world.offset_m + 2.0) < 0.02;
  });
}

// With the most points large planes are told by the sample alone, with the fewest by their pixels.
TEST(Walls, AreTheSameInASampleAndInAllPixels) {
  for (int const sample_points : {16384, 8192, 250}) {
    SCOPED_TRACE(sample_points);
    EXPECT_TRUE(is_wall_of_segments(WorldScene().with_floor().with_wall(2.0), sample_points));
    EXPECT_TRUE(is_wall_of_segments(far_wall()
                                        .with_box({-3.0, 2.0, 0.0}, {-0.3, 2.1, 2.6})
                                        .with_box({0.3, 2.0, 0.0}, {3.0, 2.1, 2.6}),
                                    sample_points));
    EXPECT_TRUE(
        is_wall_of_segments(far_wall().with_box({-3.0, 2.0, 0.0}, {0.3, 2.1, 2.6}), sample_points));
    EXPECT_FALSE(
        is_wall_of_segments(far_wall().with_box({-0.6, 2.0, 0.0}, {0.6, 2.5, 2.6}), sample_points));
    EXPECT_FALSE(is_wall_of_segments(
        WorldScene().with_floor().with_wall(2.6).with_box({-3.0, 2.0, 0.0}, {0.3, 2.6, 2.6}),
        sample_points));
    EXPECT_FALSE(
        is_wall_of_segments(far_wall().with_box({-3.0, 2.0, 0.0}, {3.0, 2.1, 1.6}), sample_points));
    EXPECT_FALSE(
        is_wall_of_segments(far_wall().with_box({-3.0, 2.0, 1.0}, {3.0, 2.1, 2.6}), sample_points));
  }
}

}  // namespace
}  // namespace credo::test
