#include "io/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace credo {
namespace {

/// The rotation of an optical frame (x right, y down, z forward) that looks along `forward`.
Eigen::Matrix3d looking_along(Eigen::Vector3d const& forward, Eigen::Vector3d const& up) {
  Eigen::Matrix3d R_world_view;
  Eigen::Vector3d const right = forward.cross(up).normalized();
  R_world_view.col(0) = right;
  R_world_view.col(1) = forward.cross(right);
  R_world_view.col(2) = forward;
  return R_world_view;
}

/// The horizontal direction the camera looks in; along x where it looks straight down.
Eigen::Vector3d heading(Se3 const& T_world_camera) {
  Eigen::Vector3d forward = T_world_camera.rotation() * Eigen::Vector3d::UnitZ();
  forward.z() = 0.0;
  return forward.norm() > 1e-3 ? Eigen::Vector3d(forward.normalized()) : Eigen::Vector3d::UnitX();
}

Se3 view_from(Eigen::Matrix3d const& R_world_view, Eigen::Vector3d const& eye_world) {
  return Se3(Eigen::Quaterniond(R_world_view), eye_world).inverse();
}

}  // namespace

std::optional<View::Projection> View::project(Eigen::Vector3d const& p_world) const {
  Eigen::Vector3d const p = T_view_world * p_world;
  if (!(p.z() > 0.05)) {
    return std::nullopt;
  }
  double const zoom = perspective ? scale / p.z() : scale;
  double const x = 0.5 * panel.width + centre_px.x() + zoom * p.x();
  double const y = 0.5 * panel.height + centre_px.y() + aspect * zoom * p.y();
  if (!(std::abs(x) < 1e6) || !(std::abs(y) < 1e6)) {
    return std::nullopt;
  }
  return Projection{static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), p.z()};
}

bool View::faces(Eigen::Vector3d const& p_world, Eigen::Vector3d const& normal_world) const {
  Eigen::Vector3d const normal = T_view_world.rotation() * normal_world;
  return perspective ? normal.dot(T_view_world * p_world) < 0.0 : normal.z() < 0.0;
}

View camera_view(Se3 const& T_world_camera, CameraIntrinsics const& intrinsics, int width_px,
                 Panel const& panel) {
  double const shrink = static_cast<double>(panel.width) / width_px;
  // Pixel centres are at whole numbers in the camera's image and at halves on a panel.
  Eigen::Vector2d const centre(shrink * (intrinsics.cx_px + 0.5) - 0.5 * panel.width,
                               shrink * (intrinsics.cy_px + 0.5) - 0.5 * panel.height);
  double const aspect = intrinsics.fy_px / intrinsics.fx_px;
  return {panel, T_world_camera.inverse(), shrink * intrinsics.fx_px, true, centre, aspect};
}

View oblique_view(Se3 const& T_world_camera, Panel const& panel) {
  Eigen::Vector3d const ahead = heading(T_world_camera);
  Eigen::Vector3d const eye =
      T_world_camera.translation() - 1.2 * ahead + Eigen::Vector3d(0, 0, 1.4);
  Eigen::Vector3d const target =
      T_world_camera.translation() + 2.0 * ahead - Eigen::Vector3d(0, 0, 0.9);
  return {panel,
          view_from(looking_along((target - eye).normalized(), Eigen::Vector3d::UnitZ()), eye),
          0.85 * panel.width, true, Eigen::Vector2d::Zero()};
}

View map_view(Se3 const& T_world_camera, Panel const& panel) {
  constexpr double kHeightM = 50.0;
  Eigen::Vector3d eye = T_world_camera.translation() + 1.5 * heading(T_world_camera);
  eye.z() = kHeightM;
  return {panel, view_from(looking_along(-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()), eye),
          panel.height / 7.0, false, Eigen::Vector2d::Zero()};
}

Splats::Splats(View const& view, Canvas& canvas)
    : view_(view),
      canvas_(canvas),
      depth_m_(view.panel.width, view.panel.height, std::numeric_limits<float>::infinity()) {}

void Splats::point(Eigen::Vector3d const& p_world, Rgb color, int radius_px, double ahead_m) {
  auto const at = view_.project(p_world);
  if (!at) {
    return;
  }
  auto const depth_m = static_cast<float>(at->depth_m - ahead_m);
  for (int y = at->y - radius_px + 1; y < at->y + radius_px; ++y) {
    for (int x = at->x - radius_px + 1; x < at->x + radius_px; ++x) {
      if (depth_m_.contains({x, y}) && depth_m < depth_m_[Pixel{x, y}]) {
        depth_m_[Pixel{x, y}] = depth_m;
        canvas_.set(view_.panel, x, y, color);
      }
    }
  }
}

void Splats::line(Eigen::Vector3d const& a_world, Eigen::Vector3d const& b_world, Rgb color,
                  LineStyle const& style) {
  // Steps of about a pixel for what is near; lines are short and few.
  double const steps_per_m = std::max(240.0, 0.5 * view_.scale);
  double const length_m = (b_world - a_world).norm();
  int const steps = std::clamp(static_cast<int>(length_m * steps_per_m), 1, 4000);
  constexpr int kDash = 10;
  for (int k = 0; k <= steps; ++k) {
    if (k % kDash < style.share * kDash) {
      double const along = static_cast<double>(k) / steps;
      point(a_world + along * (b_world - a_world), color, style.radius_px, style.ahead_m);
    }
  }
}

}  // namespace credo
