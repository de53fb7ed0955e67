#include "sim/depth_sensor.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <vector>

#include "sim/camera_path.hpp"
#include "sim/scenes.hpp"

namespace credo::test {
namespace {

/// A wall square to the camera, so far away, that fills its picture.
Scene wall_at(double depth_m) {
  Scene scene =
      small_scene({thing("wall", SceneShape::kBox, {0.1, 20, 20}, {depth_m + 0.05, 0, -10})});
  scene.camera.width_px = 160;
  scene.camera.height_px = 120;
  scene.camera.fx_px = scene.camera.fy_px = 585.0;
  scene.camera.cx_px = 79.5;
  scene.camera.cy_px = 59.5;
  return scene;
}

RenderedView view_of(Scene const& scene) {
  return RayCaster(scene).render(camera_pose(scene.camera.path, 0.0));
}

Grid<float> measured(Scene const& scene, SensorModel model, int seed = 1, std::int64_t frame = 0) {
  return measured_depth(view_of(scene), scene, model, seed, FrameIndex{frame});
}

struct Moments {
  double mean = 0.0;
  double sigma = 0.0;
  double share = 0.0;  // with depth
};

Moments moments(Grid<float> const& depth_m) {
  Moments m;
  double count = 0.0;
  double squares = 0.0;
  for (float const z : depth_m) {
    count += z > 0 ? 1 : 0;
    m.mean += z;
    squares += static_cast<double>(z) * z;
  }
  m.mean /= count;
  m.sigma = std::sqrt(squares / count - m.mean * m.mean);
  m.share = count / static_cast<double>(depth_m.size());
  return m;
}

TEST(DepthSensor, IdealIsTheView) {
  Scene const scene = wall_at(2.0);
  EXPECT_TRUE(measured(scene, SensorModel::kIdeal) == view_of(scene).depth_m);
}

// Nguyen et al. 2012, equation 3: what their fit gives at one and at three metres.
TEST(DepthSensor, GaussianNoiseGrowsAsMeasured) {
  for (auto const& [depth_m, sigma_m] : {std::pair(1.0, 0.001884), std::pair(3.0, 0.014044)}) {
    Moments const m = moments(measured(wall_at(depth_m), SensorModel::kGaussian));
    EXPECT_NEAR(m.mean, depth_m, 4 * sigma_m / std::sqrt(19200.0));
    EXPECT_NEAR(m.sigma / sigma_m, 1.0, 0.03) << depth_m;
  }
}

TEST(DepthSensor, DisparityComesInStepsAndWithoutBias) {
  // Halfway between steps and on one, averaged over depths: rounding must not pull either way.
  double bias_m = 0.0;
  for (int i = 0; i < 20; ++i) {
    double const depth_m = 2.0 + 0.011 * i / 20;
    Grid<float> const depth = measured(wall_at(depth_m), SensorModel::kDisparity, i);
    for (float const z : depth) {
      ASSERT_NEAR(351.30 / z, std::round(351.30 / z), 0.05) << "and whole millimetres";
    }
    bias_m += (moments(depth).mean - depth_m) / 20;
  }
  EXPECT_NEAR(bias_m, 0.0, 0.0005) << "a step is 11 mm here";
}

// The projector is 7.5 cm to the right: f b (1/z_front - 1/z_wall) pixels to the left are dark.
TEST(DepthSensor, AShadowFallsToTheLeftOfWhatStandsInFront) {
  Scene scene = wall_at(2.0);
  scene.things.push_back(thing("box", SceneShape::kBox, {0.02, 0.1, 4}, {1.01, 0, -1}));
  RenderedView const view = view_of(scene);
  Grid<float> const depth = measured(scene, SensorModel::kGaussian);
  int left = 0;
  while (view.thing[{left, 60}] == 0) {
    ++left;
  }
  double const expected_px = 585.0 * 0.075 * (1.0 / 1.0 - 1.0 / 2.0);
  int dark = 0;
  int lit = 0;
  for (int v = 20; v < 100; ++v) {
    for (int u = left - 1 - static_cast<int>(expected_px) + 4; u < left - 4; ++u) {
      dark += depth[{u, v}] == 0 ? 1 : 0;
      ++lit;
    }
    // Beyond the shadow and to the right of the box all is lit.
    for (int u = 0; u < left - static_cast<int>(expected_px) - 5; ++u) {
      EXPECT_GT((depth[{u, v}]), 0.0F) << u;
    }
    for (int u = left + 65; u < 155; ++u) {
      EXPECT_GT((depth[{u, v}]), 0.0F) << u;
    }
  }
  EXPECT_GT(lit, 0);
  EXPECT_GT(dark, 0.98 * lit);
}

TEST(DepthSensor, SurfacesReturnWhatTheyAre) {
  Scene scene = wall_at(3.0);
  auto const share = [&](SceneSurface surface, SensorModel model) {
    scene.things[0].surface = surface;
    Grid<float> const depth = measured(scene, model);
    double count = 0.0;
    for (float const z : depth) {
      count += z > 0 ? 1 : 0;
    }
    return count / static_cast<double>(depth.size());
  };
  EXPECT_EQ(share(SceneSurface::kGlass, SensorModel::kIdeal), 0.0);
  EXPECT_EQ(share(SceneSurface::kGlass, SensorModel::kGaussian), 0.0);
  EXPECT_EQ(share(SceneSurface::kDark, SensorModel::kIdeal), 1.0);
  EXPECT_NEAR(share(SceneSurface::kDark, SensorModel::kGaussian), 0.5, 0.03);
  EXPECT_LT(share(SceneSurface::kShiny, SensorModel::kGaussian), 0.2) << "square to it";
  EXPECT_GT(share(SceneSurface::kMatte, SensorModel::kGaussian), 0.97);
}

TEST(DepthSensor, GrazedSurfacesReturnNothing) {
  Scene scene = small_scene({thing("floor", SceneShape::kBox, {100, 100, 0.1}, {0, 0, -0.1})});
  scene.camera.max_range_m = 100.0;
  scene.camera.path[0].position_m = {0, 0, 1.0};
  Grid<float> const depth = measured(scene, SensorModel::kGaussian);
  RenderedView const view = view_of(scene);
  for (int v = 0; v < depth.height(); ++v) {
    double const incidence_deg =
        std::acos(static_cast<double>(view.incidence_cosine[{32, v}])) * 57.29578;
    if (view.depth_m[{32, v}] > 0 && incidence_deg > 87) {
      EXPECT_EQ((depth[{32, v}]), 0.0F) << incidence_deg;
    }
  }
}

TEST(DepthSensor, TheSameForTheSameSeedAndFrameAtAnyNumberOfThreads) {
  Scene const scene = wall_at(2.0);
  for (SensorModel const model : {SensorModel::kGaussian, SensorModel::kDisparity}) {
    Grid<float> const first = measured(scene, model, 7, 3);
    oneapi::tbb::global_control const one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(measured(scene, model, 7, 3) == first);
    EXPECT_FALSE(measured(scene, model, 8, 3) == first);
    EXPECT_FALSE(measured(scene, model, 7, 4) == first);
  }
}

}  // namespace
}  // namespace credo::test
