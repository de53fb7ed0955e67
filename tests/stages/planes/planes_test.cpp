#include "stages/planes/planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/world_scene.hpp"

namespace credo {
namespace {

using test::camera_looking_along_y;
using test::Shot;
using test::shot_of;
using test::WorldScene;

/// The thesis' numbers, as in config/thesis.yaml.
PlanesConfig thesis_planes() {
  PlanesConfig config;
  config.inlier_distance_m = 0.05;
  config.noise_sigmas = 0.0;
  config.max_angle_rad = 3.15;
  config.min_plane_pixels = 150;
  config.max_planes = 200;
  config.sampling = PlaneSampling::kThreePoints;
  config.floor_max_height_m = 0.0;
  config.wall_beyond = WallBeyond::kEitherSide;
  config.wall_max_points_beyond = 50;
  config.wall_max_share_beyond = 0.0;
  config.wall_min_pixels = 0;
  config.wall_min_extent_m = 0.0;
  return config;
}

/// The pictures here have a quarter of the pixels that the default is made for.
PlanesConfig default_planes() {
  PlanesConfig config;
  config.min_plane_pixels = 400;
  config.wall_min_pixels = 1000;
  return config;
}

Segmentation planes_of(Shot const& shot, PlanesConfig const& config) {
  return extract_planes(shot.frame, shot.normals, shot.unassigned(), config);
}

WorldScene room() {
  // A table of 1.2 x 0.7 m, 0.72 m high, and a box on the floor.
  return WorldScene()
      .with_floor()
      .with_wall(3.0)
      .with_box({-0.8, 1.3, 0.68}, {0.4, 2.0, 0.72})
      .with_box({0.6, 1.8, 0.0}, {0.9, 2.1, 0.4});
}

/// World height of a pixel.
double height_m(Shot const& shot, std::size_t i) {
  return (shot.T_world_camera * shot.frame.cloud_camera.at(i).cast<double>()).z();
}

class PlanesPresets : public ::testing::TestWithParam<PlanesConfig> {};

TEST_P(PlanesPresets, LabelFloorAndWallAndNothingElse) {
  Shot const shot = shot_of(room(), camera_looking_along_y(1.3, 0.4));
  PlanesConfig const& config = GetParam();
  Segmentation const result = planes_of(shot, config);
  ASSERT_TRUE(result.floor.has_value());
  ASSERT_EQ(result.walls.size(), 1U);
  EXPECT_NEAR(result.floor->plane_world.normal.z(), 1.0, 1e-3);
  EXPECT_NEAR(result.floor->plane_world.offset_m, 0.0, 0.01);
  EXPECT_NEAR(result.walls[0].plane_world.normal.y(), -1.0, 1e-3);
  EXPECT_NEAR(result.walls[0].plane_world.offset_m, -3.0, 0.02);
  double const reach_m = std::max(config.inlier_distance_m, 0.08) + 0.02;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    Eigen::Vector3d const p = shot.T_world_camera * shot.frame.cloud_camera.at(i).cast<double>();
    if (result.labels[i] == kFloor) {
      ASSERT_LT(std::abs(p.z()), reach_m) << "pixel " << i;
    } else if (is_wall(result.labels[i])) {
      ASSERT_LT(std::abs(p.y() - 3.0), reach_m) << "pixel " << i;
    } else {
      ASSERT_EQ(result.labels[i], shot.frame.cloud_camera.valid(i) ? kUnassigned : kNoDepth);
      // What is left of the floor and the wall is what the other one took.
      ASSERT_TRUE(p.hasNaN() || p.z() > 0.005 || std::abs(p.y() - 3.0) < reach_m)
          << "floor pixel " << i << " has no label";
    }
  }
}

TEST_P(PlanesPresets, LeaveATableInTheCloudThoughItIsTheLargestPlane) {
  // From close above the table, the floor is a strip.
  Shot const shot = shot_of(WorldScene().with_floor().with_box({-0.9, 0.2, 0.68}, {0.9, 1.5, 0.72}),
                            camera_looking_along_y(1.4, 0.75));
  Segmentation const result = planes_of(shot, GetParam());
  std::size_t table = 0;
  std::size_t floor = 0;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (shot.frame.cloud_camera.valid(i) && height_m(shot, i) > 0.6) {
      ASSERT_EQ(result.labels[i], kUnassigned);
      ++table;
    }
    floor += result.labels[i] == kFloor ? 1 : 0;
  }
  EXPECT_GT(floor, 1000U);
  EXPECT_GT(table, floor);
}

TEST_P(PlanesPresets, CallNothingFloorWithoutALevel) {
  Shot const shot = shot_of(room(), camera_looking_along_y(1.3, 0.4));
  Segmentation before = shot.unassigned();
  before.floor_at_zero = false;
  Segmentation const result = extract_planes(shot.frame, shot.normals, before, GetParam());
  EXPECT_FALSE(result.floor.has_value());
  EXPECT_EQ(std::ranges::count(result.labels, kFloor), 0);
}

TEST_P(PlanesPresets, LeaveLabelledPixelsAlone) {
  Shot const shot = shot_of(room(), camera_looking_along_y(1.3, 0.4));
  Segmentation before = shot.unassigned();
  for (std::size_t i = before.labels.size() / 2; i < before.labels.size(); ++i) {
    before.labels[i] = kFirstObject;
  }
  Segmentation const result = extract_planes(shot.frame, shot.normals, before, GetParam());
  for (std::size_t i = before.labels.size() / 2; i < before.labels.size(); ++i) {
    ASSERT_EQ(result.labels[i], kFirstObject);
  }
}

TEST_P(PlanesPresets, DoNotChangeWhenTheWorldIsTurnedAndShiftedLevel) {
  Shot shot = shot_of(room(), camera_looking_along_y(1.3, 0.4));
  Segmentation const result = planes_of(shot, GetParam());
  // A quarter turn keeps |n_x| or |n_y| above the wall test's bound.
  Se3 const motion(so3_exp({0.0, 0.0, M_PI / 2.0}), {3.0, -2.0, 0.0});
  shot.T_world_camera = motion * shot.T_world_camera;
  Segmentation const moved = planes_of(shot, GetParam());
  EXPECT_EQ(moved.labels, result.labels);
  ASSERT_EQ(moved.walls.size(), result.walls.size());
  EXPECT_LT(
      (moved.walls[0].plane_world.normal - transformed(motion, result.walls[0].plane_world).normal)
          .norm(),
      1e-9);
}

TEST_P(PlanesPresets, OfPicturesWithoutPlanesAreNone) {
  for (auto const& [width, height] : {std::pair{0, 0}, {1, 1}, {64, 48}}) {
    Shot shot;
    shot.frame.cloud_camera = OrganizedCloud(width, height);
    shot.normals = NormalMap(width, height);
    Segmentation const result = planes_of(shot, GetParam());
    EXPECT_FALSE(result.floor.has_value());
    EXPECT_TRUE(result.walls.empty());
    EXPECT_EQ(result.labels.size(), static_cast<std::size_t>(width) * height);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, PlanesPresets, ::testing::Values(thesis_planes(), default_planes()),
                         [](auto const& preset) {
                           return preset.index == 0 ? "Thesis" : "Default";
                         });

TEST(Walls, HaveNothingBehindThemByDefault) {
  // Before the front of a table there is nothing, but behind it is its top.
  Shot const shot = shot_of(WorldScene().with_box({-2.0, 1.0, 0.3}, {2.0, 3.5, 0.72}),
                            camera_looking_along_y(2.2, 0.9));
  PlanesConfig config = default_planes();
  EXPECT_TRUE(planes_of(shot, config).walls.empty());
  config.wall_beyond = WallBeyond::kEitherSide;
  EXPECT_EQ(planes_of(shot, config).walls.size(), 1U);
}

/// Whether a wall 2 m away is one with a niche of `side_px` squared pixels in it, 40 cm deep, and a
/// box before it: points lie on both of its sides.
bool is_wall_with_niche(int side_px, PlanesConfig const& config) {
  Shot shot = shot_of(WorldScene().with_wall(2.0).with_box({0.2, 1.0, 0.5}, {0.7, 1.4, 1.2}),
                      camera_looking_along_y(1.0, 0.0));
  OrganizedCloud& cloud = shot.frame.cloud_camera;
  for (int v = 100; v < 100 + side_px; ++v) {
    for (int u = 60; u < 60 + side_px; ++u) {
      std::size_t const i = cloud.x.index({u, v});
      cloud.set(i, cloud.at(i) * 1.2F);
    }
  }
  Segmentation const result = planes_of(shot, config);
  return std::ranges::any_of(result.walls, [](WallObservation const& wall) {
    return std::abs(wall.plane_world.offset_m + 2.0) < 0.02;
  });
}

TEST(Walls, MayHaveFiftyPointsBeyondThem) {
  EXPECT_TRUE(is_wall_with_niche(7, thesis_planes()));   // 49 points
  EXPECT_FALSE(is_wall_with_niche(8, thesis_planes()));  // 64 points
}

TEST(Walls, MayHaveAShareOfTheirSizeBeyondThemByDefault) {
  // The wall has some 60 000 pixels; 3 % of them are 1800.
  EXPECT_TRUE(is_wall_with_niche(38, default_planes()));
  EXPECT_FALSE(is_wall_with_niche(50, default_planes()));
}

TEST(Walls, FaceTheCamera) {
  for (double const y_m : {2.0, 2.5, 3.0}) {
    Shot const shot = shot_of(WorldScene().with_wall(y_m), camera_looking_along_y(1.0, 0.0));
    Segmentation const result = planes_of(shot, thesis_planes());
    ASSERT_EQ(result.walls.size(), 1U);
    EXPECT_GT(result.walls[0].plane_world.signed_distance_m(shot.T_world_camera.translation()), 0);
  }
}

TEST(Walls, AreNotWhatLeans) {
  // 10 degrees from upright: n_z = 0.17.
  WorldScene scene;
  Eigen::Vector3d const normal(0.0, -std::cos(0.175), std::sin(0.175));
  scene.planes.push_back({normal, normal.dot(Eigen::Vector3d(0.0, 2.0, 1.0))});
  Shot const shot = shot_of(scene, camera_looking_along_y(1.0, 0.0));
  EXPECT_TRUE(planes_of(shot, thesis_planes()).walls.empty());
  EXPECT_TRUE(planes_of(shot, default_planes()).walls.empty());
}

TEST(Floor, IsNotWhatLiesHigherThanAHandAboveZero) {
  Shot shot = shot_of(WorldScene().with_floor(), camera_looking_along_y(1.2, 0.5));
  shot.T_world_camera = Se3({Eigen::Quaterniond::Identity()}, {0, 0, 0.09}) * shot.T_world_camera;
  EXPECT_TRUE(planes_of(shot, thesis_planes()).floor.has_value());
  shot.T_world_camera = Se3({Eigen::Quaterniond::Identity()}, {0, 0, 0.02}) * shot.T_world_camera;
  EXPECT_FALSE(planes_of(shot, thesis_planes()).floor.has_value());
}

TEST(Floor, EndsWhereItRisesOutOfReach) {
  // A camera that believes itself 3 degrees less pitched than it is: the floor rises by 5 cm/m.
  Shot shot = shot_of(WorldScene().with_floor(), camera_looking_along_y(1.2, 0.5));
  shot.T_world_camera = camera_looking_along_y(1.2, 0.45);
  PlanesConfig config = default_planes();
  config.floor_max_mean_height_m = 0.3;
  Segmentation const result = planes_of(shot, config);
  double highest_m = 0.0;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    highest_m =
        result.labels[i] == kFloor ? std::max(highest_m, std::abs(height_m(shot, i))) : highest_m;
  }
  EXPECT_GT(highest_m, 0.11);
  EXPECT_LT(highest_m, 0.121);
}

TEST(Floor, TakesPixelsWhoseNormalsAreWrongOrMissingWhereTheyLieInIt) {
  Shot shot = shot_of(WorldScene().with_floor(), camera_looking_along_y(1.2, 0.8));
  for (std::size_t i = 0; i < shot.normals.size(); i += 3) {
    shot.normals.set(
        i, i % 2 == 0 ? Eigen::Vector3f(1.0F, 0.0F, 0.0F) : Eigen::Vector3f::Constant(kNaN));
  }
  Segmentation const result = planes_of(shot, default_planes());
  EXPECT_EQ(std::ranges::count(result.labels, kUnassigned), 0);
}

}  // namespace
}  // namespace credo
