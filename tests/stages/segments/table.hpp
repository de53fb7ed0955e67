#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "core/segments.hpp"
#include "support/rendered_scene.hpp"

namespace credo::test {

/// A table that the camera looks down on, and things on it; kinect_intrinsics, 640x480.
class Table {
public:
  explicit Table(double distance_m, double down_rad = 0.6)
      : axes_(Eigen::AngleAxisd(down_rad, Eigen::Vector3d::UnitX()).toRotationMatrix()),
        origin_(0, 0, distance_m) {
    scene_.planes = {{up(), up().dot(origin_)}};
  }

  /// Camera frame.
  [[nodiscard]] Eigen::Vector3d up() const { return -axes_.col(1); }
  /// Right, up and ahead of the table's middle.
  [[nodiscard]] Eigen::Vector3d place(double right, double up, double ahead) const {
    return origin_ + axes_ * Eigen::Vector3d(right, -up, ahead);
  }
  /// Stands on the table.
  void add_box(double right, double ahead, double yaw_rad, Eigen::Vector3d const& half_size_m) {
    add_box_at({right, half_size_m.y(), ahead}, yaw_rad, half_size_m);
  }
  /// Its middle is right, up and ahead of the table's.
  void add_box_at(Eigen::Vector3d const& middle, double yaw_rad,
                  Eigen::Vector3d const& half_size_m) {
    Eigen::Matrix3d const turned =
        axes_ * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
    scene_.bodies.push_back(box(place(middle.x(), middle.y(), middle.z()), turned, half_size_m));
  }
  void add_ball(double right, double ahead, double radius_m) {
    scene_.spheres.push_back({place(right, radius_m, ahead), radius_m});
  }
  /// An open carton with thin sides, one of its corners ahead; its sides are `side_m` long.
  void add_carton(double right, double ahead, double side_m, double height_m) {
    constexpr double kHalfSide_m = 0.004;
    constexpr double kTurn_rad = 0.7853981633974483;
    double const away_m = side_m / 2 * std::sqrt(0.5);
    for (double const u : {-away_m, away_m}) {
      for (double const v : {-away_m, away_m}) {
        add_box_at({right + u, height_m / 2, ahead + v}, u * v > 0.0 ? kTurn_rad : -kTurn_rad,
                   {side_m / 2, height_m / 2, kHalfSide_m});
      }
    }
  }

  [[nodiscard]] Grid<float> depth_m(bool noisy) const {
    Grid<float> const ideal_m = render(scene_, 640, 480, kinect_intrinsics()).depth_m;
    return noisy ? with_kinect_noise(ideal_m, 11) : ideal_m;
  }

private:
  Eigen::Matrix3d axes_;
  Eigen::Vector3d origin_;
  Scene scene_;
};

/// Of what is seen in the direction of a point; camera frame.
inline std::int32_t label_at(Segments const& segments, Eigen::Vector3d const& point) {
  CameraIntrinsics const camera = kinect_intrinsics();
  return segments.labels[Pixel{
      static_cast<int>(std::lround(camera.fx_px * point.x() / point.z() + camera.cx_px)),
      static_cast<int>(std::lround(camera.fy_px * point.y() / point.z() + camera.cy_px))}];
}

}  // namespace credo::test
