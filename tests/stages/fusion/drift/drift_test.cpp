#include "stages/fusion/drift/drift.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <vector>

#include "stages/fusion/drift/drift_room.hpp"

namespace credo {
namespace {

using test::crates;
using test::DriftRoom;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// 8 mm and 0.5 degrees along and about axes that are nobody's, of the camera's pose.
Vector6d some_error() {
  Vector6d error;
  error << 0.005, -0.004, 0.005, 0.005, 0.004, -0.006;
  return error;
}

/// What is left of an error that is told of the pose, along and about each axis, after frames that
/// tell it again and again.
Vector6d what_is_left(DriftRoom const& seen, DriftRoom const& believed, Vector6d const& told,
                      int frames = 1, DriftConfig const& config = {}) {
  Se3 const truly = test::looking_into_the_corner();
  Segmentation const frame = test::frame_of(seen, truly, boxplus(truly, told));
  BeliefState belief = test::belief_of(believed, truly);
  for (int k = 0; k < frames; ++k) {
    belief.T_world_told = tracked_drift(belief, frame, config);
  }
  return boxminus(belief.T_world_told * frame.T_world_camera, truly);
}

Vector6d what_is_left(DriftRoom const& room, Vector6d const& told, int frames = 1) {
  return what_is_left(room, room, told, frames);
}

struct Constraining {
  char const* name;
  DriftRoom room;
};

class AllDirections : public testing::TestWithParam<Constraining> {};

TEST_P(AllDirections, AreFoundAgain) {
  Vector6d const left = what_is_left(GetParam().room, some_error(), 10);
  EXPECT_LT(left.head<3>().norm(), 0.0005);
  EXPECT_LT(left.tail<3>().norm(), 0.0003);
}

INSTANTIATE_TEST_SUITE_P(
    Rooms, AllDirections,
    testing::Values(Constraining{"corner", {.floor = true, .walls = 2, .crates = {}}},
                    Constraining{"things", {.floor = false, .walls = 0, .crates = crates(6)}},
                    Constraining{"things_on_the_floor",
                                 {.floor = true, .walls = 0, .crates = crates(3)}},
                    Constraining{"all", {.floor = true, .walls = 2, .crates = crates(6)}}),
    [](auto const& of) { return of.param.name; });

TEST(Drift, WhatIsToldRightStays) {
  Vector6d const left =
      what_is_left({.floor = true, .walls = 2, .crates = crates(6)}, Vector6d::Zero(), 5);
  EXPECT_LT(left.head<3>().norm(), 1e-4);
  EXPECT_LT(left.tail<3>().norm(), 1e-4);
}

// The floor tells height, roll and pitch, and nothing of the rest.
TEST(Drift, ALoneFloorLeavesWhatItDoesNotTell) {
  Vector6d const told = some_error();
  Vector6d const left = what_is_left({.floor = true, .walls = 0, .crates = {}}, told, 5);
  EXPECT_LT(std::abs(left[2]), 2e-4);
  EXPECT_LT(std::abs(left[3]), 2e-4);
  EXPECT_LT(std::abs(left[4]), 2e-4);
  EXPECT_NEAR(left[0], told[0], 1e-5);
  EXPECT_NEAR(left[1], told[1], 1e-5);
  EXPECT_NEAR(left[5], told[5], 1e-4);
}

// Along a wall nothing tells how far: but its distance and the turn about z.
TEST(Drift, AFloorAndAWallLeaveTheWayAlongTheWall) {
  Vector6d const told = some_error();
  Vector6d const left = what_is_left({.floor = true, .walls = 1, .crates = {}}, told, 5);
  EXPECT_LT(std::abs(left[0]), 5e-4);
  EXPECT_NEAR(left[1], told[1], 1e-5);
  EXPECT_LT(left.tail<3>().norm(), 5e-4);
}

struct TooLittle {
  char const* name;
  DriftRoom room;
};

class KeepsTheLast : public testing::TestWithParam<TooLittle> {};

TEST_P(KeepsTheLast, CorrectionToTheBit) {
  Se3 const truly = test::looking_into_the_corner();
  BeliefState belief = test::belief_of(GetParam().room, truly);
  belief.T_world_told = boxplus(Se3{}, 0.5 * some_error());
  Segmentation const frame = test::frame_of(GetParam().room, truly, boxplus(truly, some_error()));
  Se3 const kept = tracked_drift(belief, frame, {});
  EXPECT_EQ(kept.matrix(), belief.T_world_told.matrix());
}

INSTANTIATE_TEST_SUITE_P(
    Rooms, KeepsTheLast,
    testing::Values(TooLittle{"nothing", {.floor = false, .walls = 0, .crates = {}}},
                    TooLittle{"one_wall", {.floor = false, .walls = 1, .crates = {}}},
                    TooLittle{"two_things", {.floor = false, .walls = 0, .crates = crates(2)}}),
    [](auto const& of) { return of.param.name; });

TEST(Drift, WithoutASightTheLastIsKept) {
  BeliefState belief = test::belief_of({.crates = crates(6)}, test::looking_into_the_corner());
  belief.T_world_told = boxplus(Se3{}, some_error());
  Se3 const kept = tracked_drift(belief, Segmentation{}, {});
  EXPECT_EQ(kept.matrix(), belief.T_world_told.matrix());
}

TEST(Drift, AgainstAnEmptyBeliefNothingIsCorrected) {
  Se3 const truly = test::looking_into_the_corner();
  Segmentation const frame = test::frame_of({.crates = crates(6)}, truly, truly);
  EXPECT_EQ(tracked_drift({}, frame, {}).matrix(), Eigen::Matrix4d::Identity());
}

// Frames are segmented with a belief that may be older than the one they are fused into.
TEST(Drift, TheCorrectionInTheFrameIsNotCountedTwice) {
  DriftRoom const room{.crates = crates(6)};
  Se3 const truly = test::looking_into_the_corner();
  Se3 const told = boxplus(truly, 4.0 * some_error());
  Se3 const latest = truly * told.inverse();
  BeliefState belief = test::belief_of(room, truly);
  belief.T_world_told = latest;
  for (Se3 const& older : {Se3{}, latest, boxplus(latest, some_error())}) {
    Segmentation frame = test::frame_of(room, truly, older * told);
    frame.T_world_told = older;
    Vector6d const left = boxminus(tracked_drift(belief, frame, {}) * told, truly);
    EXPECT_LT(left.norm(), 1e-4);
  }
}

TEST(Drift, WhatMovesDoesNotDrag) {
  std::vector<test::Crate> moved = crates(6);
  for (Eigen::Vector3d* corner : {&moved[0].min_m, &moved[0].max_m}) {
    *corner += Eigen::Vector3d(0.02, 0.02, 0.0);
  }
  Vector6d const left =
      what_is_left({.floor = true, .walls = 0, .crates = moved},
                   {.floor = true, .walls = 0, .crates = crates(6)}, Vector6d::Zero(), 10);
  EXPECT_LT(left.head<3>().norm(), 0.002);
  EXPECT_LT(left.tail<3>().norm(), 0.001);
}

class Doubtful : public testing::TestWithParam<std::pair<double, std::size_t>> {};

TEST_P(Doubtful, ThingsAreNotHeldOnTo) {
  DriftRoom const room{.floor = false, .walls = 0, .crates = crates(6)};
  Se3 const truly = test::looking_into_the_corner();
  BeliefState belief = test::belief_of(room, truly);
  for (StuffBelief& item : belief.stuff) {
    item.log_odds = GetParam().first;
    item.history_count = GetParam().second;
  }
  Segmentation const frame = test::frame_of(room, truly, boxplus(truly, some_error()));
  Se3 const kept = tracked_drift(belief, frame, {});
  EXPECT_EQ(kept.matrix(), Eigen::Matrix4d::Identity());
}

INSTANTIATE_TEST_SUITE_P(Of, Doubtful,
                         testing::Values(std::pair{2.0, std::size_t{10}},
                                         std::pair{4.0, std::size_t{2}}));

TEST(Drift, IsNoMoreThanTheConfigAllows) {
  Vector6d told = Vector6d::Zero();
  told.head<3>() << 0.03, 0.0, 0.0;
  DriftRoom const room{.crates = crates(6)};
  DriftConfig config;
  EXPECT_LT(std::abs(what_is_left(room, room, told, 20, config)[0]), 0.001);
  config.max_m = 0.01;
  EXPECT_NEAR(what_is_left(room, room, told, 20, config)[0], 0.02, 0.001);
  told.setZero();
  told[5] = 0.02;
  EXPECT_LT(std::abs(what_is_left(room, room, told, 20, config)[5]), 0.001);
  config.max_rad = 0.005;
  EXPECT_NEAR(what_is_left(room, room, told, 20, config)[5], 0.015, 0.001);
}

TEST(Drift, StepsAreAsLargeAsTheConfigExpects) {
  DriftConfig held;
  held.step_m = 1e-5;
  held.step_rad = 1e-5;
  DriftRoom const room{.crates = crates(6)};
  Vector6d const told = some_error();
  EXPECT_LT((what_is_left(room, room, told, 1, held) - told).norm(), 1e-3);
}

TEST(Drift, WhatIsNotFiniteSaysNothing) {
  DriftRoom const room{.crates = crates(6)};
  Se3 const truly = test::looking_into_the_corner();
  Segmentation frame = test::frame_of(room, truly, boxplus(truly, some_error()));
  BeliefState belief = test::belief_of(room, truly);
  belief.floor->normal.x() = kNaN;
  belief.walls[0].plane_world.offset_m = kInfinity;
  frame.walls[1].plane_world.offset_m = kNaN;
  for (std::size_t i = 0; i < frame.sight.normals_camera.size(); i += 3) {
    frame.sight.normals_camera.set(i, Eigen::Vector3f::Constant(kNaN));
  }
  StuffModel broken = *belief.stuff[0].model;
  broken.points[0].p_world.x() = kNaN;
  broken.points[1].p_world.y() = static_cast<float>(kInfinity);
  belief.stuff[0].model = std::make_shared<StuffModel const>(broken);
  Vector6d left = some_error();
  for (int k = 0; k < 15; ++k) {
    belief.T_world_told = tracked_drift(belief, frame, {});
    left = boxminus(belief.T_world_told * frame.T_world_camera, truly);
  }
  EXPECT_LT(left.head<3>().norm(), 0.001);
  EXPECT_LT(left.tail<3>().norm(), 0.0005);
}

/// Half the sum that the solver makes least: Tukey's, of each surface as far as its share.
double cost_of(std::vector<SurfaceOffsets> const& surfaces, Se3 const& T_world_camera,
               Vector6d const& error, double most_sigmas) {
  double cost = 0.0;
  Se3 const moved = boxplus(T_world_camera, error);
  for (SurfaceOffsets const& surface : surfaces) {
    auto const count = static_cast<double>(surface.offsets.size());
    double const share =
        surface.trust * (surface.kind == SurfaceKind::kThing ? 0.5 : std::min(1.0, 150.0 / count));
    for (BlockOffset const& block : surface.offsets) {
      Eigen::Vector3d const p = moved * (T_world_camera.inverse() * block.p_world);
      double const off = block.distance_m + block.normal_world.dot(p - block.p_world);
      double const inside = 1.0 - std::pow(off / block.sigma_m / most_sigmas, 2);
      cost += share * most_sigmas * most_sigmas / 6.0 * (1.0 - std::pow(std::max(inside, 0.0), 3));
    }
  }
  return cost;
}

TEST(NormalEquations, AreTheDerivativesOfTheCost) {
  Se3 const truly = test::looking_into_the_corner();
  DriftRoom const room{.crates = crates(6)};
  Se3 const told = boxplus(truly, some_error());
  BeliefState const belief = test::belief_of(room, truly);
  Segmentation const frame = test::frame_of(room, truly, told);
  std::vector<SurfaceOffsets> surfaces = DriftView(belief, frame, told).offsets(told, 4.0);
  ASSERT_GE(surfaces.size(), 8U);
  surfaces.back().trust = 0.3;
  NormalEquations const equations = normal_equations(surfaces, told.translation(), 4.0);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Vector6d step = Vector6d::Zero();
    step[i] = kStep;
    double const slope =
        (cost_of(surfaces, told, step, 4.0) - cost_of(surfaces, told, -step, 4.0)) / (2.0 * kStep);
    EXPECT_NEAR(equations.gradient[i], slope, 1e-4 * equations.gradient.norm()) << i;
  }
  // The information is that of offsets that all count as they do here.
  Matrix6d information = Matrix6d::Zero();
  for (SurfaceOffsets const& surface : surfaces) {
    for (BlockOffset const& block : surface.offsets) {
      Vector6d along;
      for (int i = 0; i < 6; ++i) {
        Vector6d step = Vector6d::Zero();
        step[i] = kStep;
        Eigen::Vector3d const p = boxplus(told, step) * (told.inverse() * block.p_world);
        along[i] = block.normal_world.dot(p - block.p_world) / kStep;
      }
      std::vector<SurfaceOffsets> const alone = {{surface.kind, {block}, surface.trust}};
      NormalEquations const one = normal_equations(alone, told.translation(), 4.0);
      double const of_all =
          surface.kind == SurfaceKind::kThing
              ? 1.0
              : std::min(1.0, 150.0 / static_cast<double>(surface.offsets.size()));
      double const weight = of_all * one.information.topLeftCorner<3, 3>().trace();
      information += weight * along * along.transpose();
    }
  }
  EXPECT_LT((equations.information - information).norm(), 1e-4 * information.norm());
}

// The obvious way: for each point the block whose pixels hold its image.
TEST(DriftView, FindsTheBlocksThatThingsWouldBeSeenIn) {
  Se3 const truly = test::looking_into_the_corner();
  DriftRoom const room{.floor = false, .walls = 0, .crates = crates(1)};
  Se3 const told = boxplus(truly, some_error());
  BeliefState belief = test::belief_of(room, truly);
  StuffModel few = *belief.stuff[0].model;
  few.points.resize(DriftView::kPointsOfItem);
  belief.stuff[0].model = std::make_shared<StuffModel const>(few);
  Segmentation const frame = test::frame_of(room, truly, told);
  std::vector<SurfaceOffsets> const found = DriftView(belief, frame, told).offsets(told, 100.0);
  std::vector<double> expected_m;
  CameraIntrinsics const& k = frame.sight.intrinsics;
  for (SurfacePoint const& point : few.points) {
    Eigen::Vector3d const p = told.inverse() * point.p_world.cast<double>();
    for (std::size_t i = 0; i < frame.labels.size(); ++i) {
      Pixel const pixel = frame.labels.pixel(i);
      bool const here = std::abs(k.fx_px * p.x() / p.z() + k.cx_px - pixel.u) < 0.5 &&
                        std::abs(k.fy_px * p.y() / p.z() + k.cy_px - pixel.v) < 0.5;
      if (here && is_stuff(frame.labels[i])) {
        double const z_m = frame.sight.depth_m[i];
        Eigen::Vector3d const seen((pixel.u - k.cx_px) / k.fx_px * z_m,
                                   (pixel.v - k.cy_px) / k.fy_px * z_m, z_m);
        expected_m.push_back(frame.sight.normals_camera.at(i).cast<double>().dot(seen - p));
      }
    }
  }
  ASSERT_EQ(found.size(), 1U);
  std::vector<double> found_m;
  for (BlockOffset const& block : found[0].offsets) {
    found_m.push_back(block.distance_m);
  }
  ASSERT_GE(expected_m.size(), 40U);
  EXPECT_THAT(found_m, testing::Pointwise(testing::DoubleNear(1e-9), expected_m));
}

TEST(Drift, IsTheSameAtAnyNumberOfThreads) {
  DriftRoom const room{.crates = crates(6)};
  Vector6d results[2];
  for (std::size_t const threads : {1U, 2U}) {
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, threads);
    results[threads - 1] = what_is_left(room, some_error(), 2);
  }
  EXPECT_EQ(results[0], results[1]);
}

}  // namespace
}  // namespace credo
