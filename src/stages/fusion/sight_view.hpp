#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>

#include "core/evidence.hpp"
#include "core/se3.hpp"
#include "core/sight.hpp"

namespace credo {

/// How far a measured depth may lie from a point that it agrees with.
[[nodiscard]] constexpr float agreement_m(float depth_m) {
  return 0.01F + 0.01F * depth_m;
}

/// What a frame says of a point `point_m` along the optical axis: `measured_m` is the depth of the
/// block that it falls on, `nearest_m` the least around that.
[[nodiscard]] inline PointState state_of(float point_m, float measured_m, float nearest_m) {
  using enum PointState;
  // A table, as nobody can guess which of the states comes next: there are no branches here.
  constexpr std::array kStates = {kOccluded,   kSeenThrough, kAgrees,     kAgrees,
                                  kUnmeasured, kUnmeasured,  kUnmeasured, kUnmeasured};
  float const tolerance_m = agreement_m(point_m);
  auto const is_through = static_cast<unsigned>(nearest_m > point_m + tolerance_m);
  auto const is_near = static_cast<unsigned>(measured_m > point_m - tolerance_m) &
                       static_cast<unsigned>(measured_m < point_m + tolerance_m);
  auto const is_unmeasured = static_cast<unsigned>(!(measured_m > 0.0F));
  return kStates[is_through | is_near << 1U | is_unmeasured << 2U];
}

/// A frame's blocks, looked at from where its camera stood.
class SightView {
public:
  /// `sight` must outlive it.
  SightView(Sight const& sight, Se3 const& T_world_camera) : sight_(sight) {
    Se3 const T_camera_world = T_world_camera.inverse();
    R_camera_world_ = T_camera_world.rotation().toRotationMatrix().cast<float>();
    t_camera_world_ = T_camera_world.translation().cast<float>();
    CameraIntrinsics const& k = sight.intrinsics;
    auto const block_px = static_cast<float>(sight.block_px);
    focal_blocks_ = Eigen::Vector2d(k.fx_px, k.fy_px).cast<float>() / block_px;
    centre_blocks_ = Eigen::Vector2d(k.cx_px + 0.5, k.cy_px + 0.5).cast<float>() / block_px;
  }

  [[nodiscard]] Sight const& sight() const { return sight_; }
  [[nodiscard]] float focal_blocks() const { return focal_blocks_.x(); }
  [[nodiscard]] Eigen::Vector3f in_camera(Eigen::Vector3f const& p_world) const {
    return R_camera_world_ * p_world + t_camera_world_;
  }

  /// The block that a point falls on; none out of view.
  [[nodiscard]] std::optional<Pixel> block_of(Eigen::Vector3f const& p_camera) const {
    if (!(p_camera.z() > 0.0F)) {
      return std::nullopt;
    }
    float const u = focal_blocks_.x() * (p_camera.x() / p_camera.z()) + centre_blocks_.x();
    float const v = focal_blocks_.y() * (p_camera.y() / p_camera.z()) + centre_blocks_.y();
    bool const inside = u >= 0.0F && v >= 0.0F && u < static_cast<float>(sight_.depth_m.width()) &&
                        v < static_cast<float>(sight_.depth_m.height());
    return inside ? std::optional(Pixel{static_cast<int>(u), static_cast<int>(v)}) : std::nullopt;
  }

  /// Whether all that lies within a box is out of view. A box is convex: where all its corners lie
  /// beyond one edge of the image, so does what is in it. The margin is for what rounding makes of
  /// a point.
  [[nodiscard]] bool is_out_of_view(Eigen::AlignedBox3f const& bounds_world) const {
    constexpr float kMargin = 1e-3F;
    auto const width = static_cast<float>(sight_.depth_m.width());
    auto const height = static_cast<float>(sight_.depth_m.height());
    std::array<int, 5> beyond{};
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::Vector3f const p =
          in_camera(bounds_world.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)));
      float const u_z = focal_blocks_.x() * p.x() + centre_blocks_.x() * p.z();
      float const v_z = focal_blocks_.y() * p.y() + centre_blocks_.y() * p.z();
      beyond[0] += p.z() < -kMargin ? 1 : 0;
      beyond[1] += u_z < -kMargin * width ? 1 : 0;
      beyond[2] += v_z < -kMargin * height ? 1 : 0;
      beyond[3] += u_z - width * p.z() > kMargin * width ? 1 : 0;
      beyond[4] += v_z - height * p.z() > kMargin * height ? 1 : 0;
    }
    return std::ranges::find(beyond, 8) != beyond.end();
  }

  [[nodiscard]] PointState look_at(Eigen::Vector3f const& p_world) const {
    Eigen::Vector3f const p_camera = in_camera(p_world);
    std::optional<Pixel> const block = block_of(p_camera);
    return block ? state_of(p_camera.z(), sight_.depth_m[*block], sight_.nearest_m[*block])
                 : PointState::kOutOfView;
  }

private:
  Sight const& sight_;
  Eigen::Matrix3f R_camera_world_;
  Eigen::Vector3f t_camera_world_;
  /// Of the camera, in blocks instead of pixels.
  Eigen::Vector2f focal_blocks_;
  Eigen::Vector2f centre_blocks_;
};

}  // namespace credo
