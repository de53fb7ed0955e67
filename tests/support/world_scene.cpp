#include "support/world_scene.hpp"

#include <Eigen/Geometry>

#include "support/rendered_scene.hpp"

namespace credo::test {

Se3 camera_looking_along_y(double height_m, double pitch_rad) {
  Eigen::Matrix3d level;
  level.col(0) = Eigen::Vector3d::UnitX();
  level.col(1) = -Eigen::Vector3d::UnitZ();
  level.col(2) = Eigen::Vector3d::UnitY();
  // About the camera's x (right), a positive turn takes z (forward) to -y (up).
  Eigen::Quaterniond const turn(Eigen::AngleAxisd(-pitch_rad, Eigen::Vector3d::UnitX()));
  return {Eigen::Quaterniond(level) * turn, {0.0, 0.0, height_m}};
}

WorldScene& WorldScene::with_floor() {
  planes.push_back({Eigen::Vector3d::UnitZ(), 0.0});
  return *this;
}

WorldScene& WorldScene::with_wall(double y_m) {
  planes.push_back({-Eigen::Vector3d::UnitY(), -y_m});
  return *this;
}

WorldScene& WorldScene::with_box(Eigen::Vector3d const& min_m, Eigen::Vector3d const& max_m) {
  boxes.push_back({min_m, max_m});
  return *this;
}

Shot shot_of(WorldScene const& scene, Se3 const& T_world_camera) {
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  CameraIntrinsics const intrinsics{290.0, 290.0, 159.5, 119.5};
  Se3 const T_camera_world = T_world_camera.inverse();
  Scene seen;
  for (Plane const& plane : scene.planes) {
    seen.planes.push_back(transformed(T_camera_world, plane));
  }
  for (WorldScene::Box const& b : scene.boxes) {
    seen.bodies.push_back(box(T_camera_world * Eigen::Vector3d(0.5 * (b.min_m + b.max_m)),
                              T_camera_world.rotation().toRotationMatrix(),
                              0.5 * (b.max_m - b.min_m)));
  }
  Rendering rendering = render(seen, kWidth, kHeight, intrinsics);
  Shot shot;
  shot.frame.intrinsics = intrinsics;
  shot.frame.cloud_camera = cloud_from_depth(std::move(rendering.depth_m), intrinsics);
  shot.normals = std::move(rendering.normals);
  shot.T_world_camera = T_world_camera;
  return shot;
}

}  // namespace credo::test
