#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/cloud.hpp"
#include "core/grid.hpp"
#include "core/se3.hpp"

namespace credo {

/// Position of a frame in its source, from 0. Frames that fail or are dropped keep their number.
enum class FrameIndex : std::int64_t {};

/// "The belief used was the prior": no frame came before.
inline constexpr FrameIndex kPriorFrame{-1};

[[nodiscard]] constexpr std::int64_t number(FrameIndex index) {
  return static_cast<std::int64_t>(index);
}

/// Pinhole model without distortion, pixels: u = fx x / z + cx, v = fy y / z + cy.
struct CameraIntrinsics {
  double fx_px = 525.0;
  double fy_px = 525.0;
  double cx_px = 319.5;
  double cy_px = 239.5;
  friend bool operator==(CameraIntrinsics const&, CameraIntrinsics const&) = default;
};

using Rgb = std::array<std::uint8_t, 3>;

/// One RGB-D observation as a source delivers it. Built once, then shared as `FramePtr`.
struct Frame {
  FrameIndex index{0};
  /// Time of exposure; sources without stamps count 1/30 s a frame.
  std::int64_t stamp_ns = 0;
  /// When a live sensor's depth came, by this computer's clock, since 1970; else 0.
  std::int64_t arrival_ns = 0;
  CameraIntrinsics intrinsics;
  OrganizedCloud cloud_camera;
  /// Same size as the cloud, or empty where the source has no colour.
  Grid<Rgb> color;
  /// Each pixel's colour is that of its point; otherwise it is seen from beside.
  bool color_registered = false;
  /// Where the camera stood, in the frame that the pose source counts in (not necessarily level).
  Se3 T_source_camera;
};
using FramePtr = std::shared_ptr<Frame const>;

/// Points of a depth image [m] (not positive or not finite = invalid) by the pinhole model.
OrganizedCloud cloud_from_depth(Grid<float> depth_m, CameraIntrinsics const& intrinsics);

}  // namespace credo
