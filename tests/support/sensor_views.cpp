#include "support/sensor_views.hpp"

#include <cmath>
#include <utility>

#include "sim/camera_path.hpp"
#include "sim/depth_sensor.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene_caster.hpp"

namespace credo::test {
namespace {

void set_camera(Scene& scene, CameraIntrinsics const& intrinsics) {
  scene.camera.width_px = 640;
  scene.camera.height_px = 480;
  scene.camera.fx_px = intrinsics.fx_px;
  scene.camera.fy_px = intrinsics.fy_px;
  scene.camera.cx_px = intrinsics.cx_px;
  scene.camera.cy_px = intrinsics.cy_px;
}

Grid<Rgb> blurred(Grid<Rgb> const& color) {
  Grid<Rgb> result = color;
  for (int v = 1; v + 1 < color.height(); ++v) {
    for (int u = 1; u + 1 < color.width(); ++u) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int k = 0; k < 9; ++k) {
          sum += color[Pixel{u + k % 3 - 1, v + k / 3 - 1}][channel];
        }
        result[Pixel{u, v}][channel] = static_cast<std::uint8_t>(sum / 9);
      }
    }
  }
  return result;
}

}  // namespace

SensorViews sensor_views(Scene scene, SensorModel model, double since_s) {
  DepthCalibration const calibration = kinect_calibration();
  double const time_s = scene.camera.path.front().time_s + since_s;
  Se3 const T_world_color = camera_pose(scene.camera.path, time_s);
  FrameIndex const index{std::llround(since_s * 30.0)};

  set_camera(scene, calibration.color);
  RenderedView const color_view = SceneCaster(scene).at(time_s).render(T_world_color);
  Grid<float> registered_m = measured_depth(color_view, scene, model, 1, index);
  set_camera(scene, calibration.depth);
  RenderedView const depth_view =
      SceneCaster(scene).at(time_s).render(T_world_color * calibration.T_color_depth);
  return {.depth_m = measured_depth(depth_view, scene, model, 1, index),
          .registered_m = std::move(registered_m),
          .color = blurred(color_view.color)};
}

}  // namespace credo::test
