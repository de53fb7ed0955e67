#include "sim/sim_source.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "core/error.hpp"
#include "sim/camera_path.hpp"
#include "sim/scenes.hpp"

namespace credo::test {
namespace {

Scene moving_scene() {
  Scene scene = small_scene({thing("floor", SceneShape::kBox, {9, 9, 0.05}, {0, 0, -0.05}),
                             thing("ball", SceneShape::kSphere, {0.3}, {2, 0.1, 0})});
  scene.camera.frames_per_s = 10.0;
  scene.camera.path = {{2.0, {0, 0, 1}, {2, 0, 0}}, {2.5, {0, 0.4, 1.2}, {2, 0, 0}}};
  return scene;
}

FramePtr next_frame(SimSource& source) {
  return std::get<FramePtr>(source.next());
}

TEST(SimSource, GivesAFrameEachPeriodFromTheFirstWaypointToTheLast) {
  Scene const scene = moving_scene();
  SimSource source(scene, {});
  EXPECT_EQ(source.frame_count(), 6U);
  for (std::int64_t i = 0; i < 6; ++i) {
    FramePtr const frame = next_frame(source);
    EXPECT_EQ(number(frame->index), i);
    EXPECT_EQ(frame->stamp_ns, i * 100'000'000);
    Se3 const expected = camera_pose(scene.camera.path, 2.0 + 0.1 * static_cast<double>(i));
    EXPECT_NEAR((frame->T_source_camera.matrix() - expected.matrix()).norm(), 0, 1e-12);
    EXPECT_EQ(frame->intrinsics, (CameraIntrinsics{60.0, 62.0, 31.5, 23.5}));
    EXPECT_TRUE(frame->color.same_size(frame->cloud_camera.z));
    EXPECT_TRUE(frame->color_registered);
  }
  for (int again = 0; again < 2; ++again) {
    EXPECT_TRUE(std::holds_alternative<EndOfSource>(source.next()));
  }
}

TEST(SimSource, PointsOfTheFloorLieOnIt) {
  SimSource source(moving_scene(), {});
  for (int i = 0; i < 6; ++i) {
    FramePtr const frame = next_frame(source);
    std::size_t on_floor = 0;
    for (std::size_t p = 0; p < frame->cloud_camera.size(); ++p) {
      if (frame->cloud_camera.valid(p)) {
        Eigen::Vector3d const world =
            frame->T_source_camera * frame->cloud_camera.at(p).cast<double>();
        EXPECT_GT(world.z(), -1e-5);
        on_floor += world.z() < 1e-5 ? 1 : 0;
      }
    }
    EXPECT_GT(on_floor, frame->cloud_camera.size() / 4);
  }
}

TEST(SimSource, AFixedSensorIsToldNothingOfItsWay) {
  PoseConfig pose;
  pose.source = PoseSource::kFixed;
  SimSource source(moving_scene(), pose);
  next_frame(source);
  EXPECT_EQ(next_frame(source)->T_source_camera.matrix(), Eigen::Matrix4d::Identity());
}

TEST(SimSource, RefusesPosesFromAFile) {
  PoseConfig pose;
  pose.source = PoseSource::kFile;
  try {
    SimSource const source(moving_scene(), pose);
    FAIL();
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(),
                 "scene test: a simulated camera has its own poses; pose.source must not be file");
  }
}

TEST(SimSource, ACameraAtRestGivesOneFrame) {
  Scene scene = moving_scene();
  scene.camera.path.resize(1);
  SimSource source(scene, {});
  EXPECT_EQ(source.frame_count(), 1U);
}

TEST(SimSource, IsTheSameEveryTime) {
  SimSource a(moving_scene(), {});
  SimSource b(moving_scene(), {});
  FramePtr const first = next_frame(a);
  FramePtr const second = next_frame(b);
  std::size_t valid = 0;
  for (std::size_t p = 0; p < first->cloud_camera.size(); ++p) {
    ASSERT_EQ(first->color[p], second->color[p]);
    ASSERT_EQ(first->cloud_camera.valid(p), second->cloud_camera.valid(p));
    if (first->cloud_camera.valid(p)) {
      ASSERT_EQ(first->cloud_camera.at(p), second->cloud_camera.at(p));
      ++valid;
    }
  }
  EXPECT_GT(valid, 1000U);
}

}  // namespace
}  // namespace credo::test
