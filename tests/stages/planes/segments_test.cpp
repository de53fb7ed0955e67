// Floor and walls made of segments that are known to be right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stages/planes/planes.hpp"
#include "stages/planes/small_shots.hpp"

namespace credo::test {
namespace {

Segmentation segmented(Shot const& shot, SegmentOf const& segment_of) {
  Segmentation segmentation = shot.unassigned();
  segmentation.segments = segments_of(shot, segment_of);
  return segmentation;
}

Segmentation planes_of(Shot const& shot, SegmentOf const& segment_of,
                       PlanesConfig const& config = small_planes()) {
  return extract_planes(shot.frame, shot.normals, segmented(shot, segment_of), config);
}

bool is_on_floor(Eigen::Vector3d const& p) {
  return p.z() < 1e-3;
}

TEST(PlanesOfSegments, TheFootOfAThingIsNotFloor) {
  Shot const shot = shot_of(WorldScene().with_floor().with_box({-0.3, 1.2, 0.0}, {0.3, 1.8, 0.3}),
                            camera_looking_along_y(1.0, 0.6));
  PlanesConfig by_distance = small_planes();
  by_distance.max_angle_rad = 3.15;
  auto const foot_pixels = [&](Segmentation const& result) {
    std::size_t foot = 0;
    for (std::size_t i = 0; i < result.labels.size(); ++i) {
      foot += result.labels[i] == kFloor && !is_on_floor(position_m(shot, i)) ? 1 : 0;
    }
    return foot;
  };
  EXPECT_GT(foot_pixels(extract_planes(shot.frame, shot.normals, shot.unassigned(), by_distance)),
            100U)
      << "by distance alone";
  Segmentation const result = planes_of(
      shot, [](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : 2; }, by_distance);
  EXPECT_EQ(foot_pixels(result), 0U);
  ASSERT_TRUE(result.floor);
}

TEST(PlanesOfSegments, WhatIsFloorByItsSegmentIsFloorAlsoWhereItIsRough) {
  Shot shot = shot_of(WorldScene().with_floor(), camera_looking_along_y(1.3, 0.6));
  // Every 499th pixel 5 cm too near: beyond the tolerance, within three.
  for (std::size_t i = 0; i < shot.frame.cloud_camera.size(); i += 499) {
    if (shot.frame.cloud_camera.valid(i)) {
      Eigen::Vector3f const p = shot.frame.cloud_camera.at(i);
      shot.frame.cloud_camera.set(i, p * (1.0F - 0.05F / p.norm()));
    }
  }
  Segmentation const result = planes_of(shot, [](Eigen::Vector3d const&) { return 1; });
  std::size_t missing = 0;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    missing += result.labels[i] == kUnassigned ? 1 : 0;
  }
  EXPECT_EQ(missing, 0U);
  EXPECT_LT(extract_planes(shot.frame, shot.normals, shot.unassigned(), small_planes())
                .floor->pixel_count,
            result.floor->pixel_count);
}

TEST(PlanesOfSegments, WhatLiesOnTheFloorIsNotFloor) {
  // A centimetre high: well within the tolerance.
  Shot const shot = shot_of(WorldScene().with_floor().with_box({-0.3, 0.9, 0.0}, {0.3, 1.4, 0.01}),
                            camera_looking_along_y(1.0, 0.8));
  auto const segment_of = [](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : 2; };
  Segmentation segmentation = segmented(shot, segment_of);
  for (bool const lies_there : {false, true}) {
    segmentation.segments.lies_on.assign(segmentation.segments.pixel_counts.size(), 0);
    segmentation.segments.lies_on[1] = lies_there ? 1 : 0;
    Segmentation const result =
        extract_planes(shot.frame, shot.normals, segmentation, small_planes());
    for (std::size_t i = 0; i < result.labels.size(); ++i) {
      if (segmentation.segments.labels[i] == 2) {
        ASSERT_EQ(result.labels[i], lies_there ? kUnassigned : kFloor);
      }
    }
  }
}

TEST(PlanesOfSegments, WhatJoinsAPlaneIsNotFoundAgainInTheNext) {
  // A step of 3 cm in the floor: beyond the tolerance, large enough for a plane of its own.
  Shot const shot = shot_of(WorldScene().with_floor().with_box({-0.3, 0.9, 0.0}, {0.3, 1.4, 0.03}),
                            camera_looking_along_y(1.0, 0.8));
  Segmentation const result = planes_of(shot, [](Eigen::Vector3d const&) { return 1; });
  std::size_t floor = 0;
  for (LabelCode const label : result.labels) {
    floor += label == kFloor ? 1 : 0;
  }
  ASSERT_TRUE(result.floor);
  EXPECT_LE(result.floor->pixel_count, floor) << "counted twice";
  EXPECT_EQ(std::ranges::count(result.labels, kUnassigned), 0);
}

TEST(PlanesOfSegments, WallsThatShareASegmentAreBothFound) {
  // The camera looks into a corner whose crease nobody has seen.
  WorldScene scene = WorldScene().with_wall(3.0);
  scene.with_box({1.0, -5.0, 0.0}, {1.1, 3.0, 2.6});
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.1));
  EXPECT_EQ(planes_of(shot, [](Eigen::Vector3d const&) { return 1; }).walls.size(), 2U);
}

TEST(PlanesOfSegments, WhatFacesElsewhereIsThePartOfAnotherWall) {
  // As above, and most of the segment is the wall in front.
  WorldScene scene = WorldScene().with_wall(3.0);
  scene.with_box({1.2, -5.0, 0.0}, {1.3, 3.0, 2.6});
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.1));
  Segmentation const result = planes_of(shot, [](Eigen::Vector3d const&) { return 1; });
  ASSERT_EQ(result.walls.size(), 2U);
  for (WallObservation const& wall : result.walls) {
    for (Eigen::Vector3f const& p : wall.points_world) {
      ASSERT_LT(std::abs(wall.plane_world.signed_distance_m(p.cast<double>())), 0.06);
    }
  }
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    Eigen::Vector3d const p = position_m(shot, i);
    bool const beside = p.x() > 1.2 - 1e-3;
    if (beside ? p.y() < 2.99 : p.x() < 1.19) {
      ASSERT_EQ(result.labels[i], result.walls[beside ? 1 : 0].label) << "pixel " << i;
    }
  }
}

TEST(PlanesOfSegments, WhatAWallGivesBackIsLeftForTheNext) {
  // Where two walls meet, each reaches the other's pixels by distance.
  WorldScene scene = WorldScene().with_wall(3.0);
  scene.with_box({1.2, -5.0, 0.0}, {1.3, 3.0, 2.6});
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.1));
  PlanesConfig by_distance = small_planes();
  by_distance.max_angle_rad = 3.15;
  auto const is_beside = [](Eigen::Vector3d const& p) {
    return p.x() > 1.2 - 1e-3 && p.y() < 3.0 - 1e-3;
  };
  Segmentation const result = planes_of(
      shot, [&](Eigen::Vector3d const& p) { return is_beside(p) ? 2 : 1; }, by_distance);
  ASSERT_EQ(result.walls.size(), 2U);
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (shot.frame.cloud_camera.valid(i)) {
      bool const beside = is_beside(position_m(shot, i));
      ASSERT_EQ(result.labels[i], result.walls[beside ? 1 : 0].label) << "pixel " << i;
    }
  }
}

TEST(PlanesOfSegments, AWallAndADoorBeforeItAreNotOnePlaneBetweenBoth) {
  // Along a corridor: farther on, noise hides that the door stands before the wall.
  WorldScene scene = WorldScene().with_floor();
  scene.with_box({1.0, -1.0, 0.0}, {1.1, 8.0, 2.6}).with_box({0.94, 1.2, 0.0}, {1.0, 2.8, 2.2});
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.1));
  Segmentation const result = planes_of(shot, [](Eigen::Vector3d const& p) {
    if (p.x() > 1.0 - 1e-3) {
      return 1;
    }
    return is_on_floor(p) ? 2 : 3;
  });
  ASSERT_FALSE(result.walls.empty());
  for (WallObservation const& wall : result.walls) {
    EXPECT_LT(wall.plane_world.normal.x(), -0.9999);
    double const x_m = -wall.plane_world.offset_m;
    EXPECT_LT(std::min(std::abs(x_m - 1.0), std::abs(x_m - 0.94)), 0.002) << x_m;
  }
}

TEST(PlanesOfSegments, NoiseMakesNoHolesInAWall) {
  // Six of eleven pixels lie 1.8 cm too near, within the tolerance, and their normals are turned:
  // most by 45 degrees, some by 90.
  Shot shot = shot_of(WorldScene().with_wall(2.0), camera_looking_along_y(1.3, 0.0));
  for (std::size_t i = 0; i < shot.normals.size(); ++i) {
    if (i % 11 < 6) {
      Eigen::Vector3f const p = shot.frame.cloud_camera.at(i);
      shot.frame.cloud_camera.set(i, p * ((p.z() - 0.018F) / p.z()));
      shot.normals.set(i, i % 11 < 5 ? Eigen::Vector3f(std::sqrt(0.5F), 0.0F, -std::sqrt(0.5F))
                                     : Eigen::Vector3f(1.0F, 0.0F, 0.0F));
    }
  }
  Segmentation const result = planes_of(shot, [](Eigen::Vector3d const&) { return 1; });
  EXPECT_EQ(result.walls.size(), 1U);
  EXPECT_EQ(std::ranges::count(result.labels, kUnassigned), 0);
}

TEST(PlanesOfSegments, WhatHoldsHardlyAnythingOfItsSegmentsIsNoWall) {
  // A strip of wall above a ground that nothing says is the floor.
  Shot const shot =
      shot_of(WorldScene().with_floor().with_wall(6.0), camera_looking_along_y(1.3, 0.5));
  auto const walls_of = [&](std::int32_t segment_of_wall) {
    Segmentation before = segmented(
        shot, [&](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : segment_of_wall; });
    before.floor_at_zero = false;
    return extract_planes(shot.frame, shot.normals, before, small_planes()).walls.size();
  };
  EXPECT_EQ(walls_of(2), 1U);
  EXPECT_EQ(walls_of(1), 0U);
}

TEST(PlanesOfSegments, ObservationsCountWhatTheyHaveInTheEnd) {
  Shot const shot =
      shot_of(WorldScene().with_floor().with_wall(3.0), camera_looking_along_y(1.3, 0.4));
  Segmentation const result =
      planes_of(shot, [](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : 2; });
  std::size_t floor = 0;
  std::size_t wall = 0;
  for (LabelCode const label : result.labels) {
    floor += label == kFloor ? 1 : 0;
    wall += is_wall(label) ? 1 : 0;
  }
  ASSERT_EQ(result.walls.size(), 1U);
  EXPECT_EQ(result.floor->pixel_count, floor);
  EXPECT_EQ(result.walls[0].pixel_count, wall);
}

}  // namespace
}  // namespace credo::test
