#include "stages/capture/level_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/plane.hpp"
#include "stages/capture/floor_search.hpp"

namespace credo {
namespace {

constexpr std::int64_t kEvery_ns = 1'000'000'000;
constexpr int kLooks = 3;
constexpr double kMostTilt_rad = 2.0 * std::numbers::pi / 180.0;
constexpr double kMostRise_m = 0.04;
constexpr double kOtherSurface_m = 0.3;

/// The floor as it is seen now, by the level of the start.
struct FloorNow {
  double tilt_rad = 0.0;
  /// Below the camera, above z = 0.
  double rise_m = 0.0;
};

std::string told(FloorNow const& floor, bool given) {
  char const* const against = given ? "the calibration; put it back, or calibrate anew"
                                    : "the start; put it back, or start anew";
  std::array<char, 240> text{};
  // NOLINTNEXTLINE(*-vararg)
  std::snprintf(
      text.data(), text.size(),
      "the camera has moved: the floor is %.1f degrees off level and %.0f mm %s than at %s",
      floor.tilt_rad * 180.0 / std::numbers::pi, std::abs(floor.rise_m) * 1000.0,
      floor.rise_m < 0.0 ? "lower" : "higher", against);
  return text.data();
}

}  // namespace

std::optional<std::string> LevelWatch::look(Frame const& frame) {
  if (looked_at_ns_ && frame.stamp_ns - *looked_at_ns_ < kEvery_ns) {
    return std::nullopt;
  }
  looked_at_ns_ = frame.stamp_ns;
  std::optional<Plane> const floor_camera = find_floor(frame.cloud_camera);
  if (!floor_camera) {
    return std::nullopt;
  }
  Se3 const T_world_camera = T_world_source_ * frame.T_source_camera;
  Plane const floor = transformed(T_world_camera, *floor_camera);
  Eigen::Vector3d const& camera = T_world_camera.translation();
  FloorNow const now{std::acos(std::clamp(floor.normal.z(), -1.0, 1.0)),
                     camera.z() - floor.signed_distance_m(camera) / floor.normal.z()};
  bool const tilted = now.tilt_rad > kMostTilt_rad;
  if (!tilted && std::abs(now.rise_m) > kOtherSurface_m) {
    return std::nullopt;
  }
  bool const moved = tilted || std::abs(now.rise_m) > kMostRise_m;
  against_ = moved == moved_ ? 0 : against_ + 1;
  if (against_ < kLooks) {
    return std::nullopt;
  }
  moved_ = moved;
  against_ = 0;
  if (moved) {
    return told(now, given_);
  }
  return given_ ? "the camera stands as it did at the calibration again"
                : "the camera stands as it did at the start again";
}

}  // namespace credo
