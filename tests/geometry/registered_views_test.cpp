// Depth registered in software, beside what a depth camera in the colour camera's place sees.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "geometry/depth_registration.hpp"
#include "support/sensor_views.hpp"
#include "tools/scene_file.hpp"

namespace credo {
namespace {

/// Step between depths that a Kinect tells apart.
double quantum_m(double depth_m) {
  return depth_m * depth_m / 351.3;
}

class RegisteredViews : public testing::TestWithParam<char const*> {};

TEST_P(RegisteredViews, AreWithinAQuantum) {
  auto const views = test::sensor_views(load_scene(GetParam()), SensorModel::kIdeal, 1.0);
  Grid<float> const registered_m = register_depth(views.depth_m, kinect_calibration(), 640, 480);
  int both = 0;
  int close = 0;
  int holes = 0;
  int beyond = 0;
  for (int v = 40; v < 440; ++v) {
    for (int u = 40; u < 600; ++u) {
      float const found = registered_m[Pixel{u, v}];
      float const expected = views.registered_m[Pixel{u, v}];
      both += found > 0.0F && expected > 0.0F ? 1 : 0;
      close += found > 0.0F && std::abs(found - expected) <= quantum_m(expected) ? 1 : 0;
      holes += found == 0.0F && expected > 0.0F ? 1 : 0;
      // Background where something stands in front.
      beyond += expected > 0.0F && found > 1.1F * expected ? 1 : 0;
    }
  }
  ASSERT_GT(both, 150000);
  // What is not lies at the rims of things, where a pixel of one camera falls on both sides.
  EXPECT_GT(close, 0.995 * both);
  EXPECT_LT(beyond, 0.004 * both);
  // What only the colour camera sees.
  EXPECT_LT(holes, 0.03 * both);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RegisteredViews,
                         testing::Values("cluttered-table", "first-light", "wall-and-floor"));

}  // namespace
}  // namespace credo
