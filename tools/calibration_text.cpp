#include "calibration_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

#include "rounding.hpp"

namespace credo {
namespace {

// A still Kinect's frames differ by a tenth of these.
constexpr double kMostSpread_m = 0.01;
constexpr double kMostSpread_deg = 0.5;
constexpr double kMostLean_deg = 2.0;

double degrees(double rad) {
  return rad * 180.0 / std::numbers::pi;
}

std::string angle_row(char const* name, double value_rad, std::optional<double> spread_rad) {
  return fmt::format("{:<8}{:>11.3f} deg", name, rounded(degrees(value_rad), 3)) +
         (spread_rad ? fmt::format("{:>11.3f} deg\n", degrees(*spread_rad)) : "          -\n");
}

std::string length_row(char const* name, double value_m, std::optional<double> spread_m) {
  return fmt::format("{:<8}{:>11.4f} m  ", name, rounded(value_m, 4)) +
         (spread_m ? fmt::format("{:>11.2f} mm\n", 1000.0 * *spread_m) : "          -\n");
}

std::string surface_text(StillSurface const& surface, CalibrationOrigin const& origin) {
  return fmt::format("in {} of {} frames, {} points, {:.1f} mm rms", surface.frame_count,
                     origin.frames, surface.point_count, 1000.0 * surface.rms_m);
}

/// On one line, whatever a file is called.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

}  // namespace

std::string calibration_table(Calibration const& calibration, CalibrationOrigin const& origin) {
  CameraStand const& camera = calibration.camera;
  std::optional<CameraStand> const& spread = calibration.spread;
  auto const spread_of = [&](double CameraStand::*member) {
    return spread ? std::optional((*spread).*member) : std::nullopt;
  };
  std::string table = "              camera       spread over frames\n" +
                      angle_row("pitch", camera.pitch_rad, spread_of(&CameraStand::pitch_rad)) +
                      angle_row("roll", camera.roll_rad, spread_of(&CameraStand::roll_rad)) +
                      length_row("height", camera.height_m, spread_of(&CameraStand::height_m));
  if (calibration.wall) {
    table += angle_row("yaw", camera.yaw_rad, spread_of(&CameraStand::yaw_rad)) +
             length_row("to wall", camera.x_m, spread_of(&CameraStand::x_m));
  }
  table += "floor   " + surface_text(calibration.floor, origin) + '\n';
  if (calibration.wall) {
    table +=
        "wall    " + surface_text(*calibration.wall, origin) +
        fmt::format(", {:.2f} deg off upright\n", std::abs(degrees(calibration.wall_lean_rad)));
  }
  return table;
}

std::string calibration_yaml(Calibration const& calibration, CalibrationOrigin const& origin) {
  CameraStand const& camera = calibration.camera;
  std::string text = "# Where the camera of " + one_line(origin.source) +
                     " stands, by credo calibrate.\n# Floor (z = 0) " +
                     surface_text(calibration.floor, origin) + ".\n";
  if (calibration.wall) {
    text +=
        "# Wall (x = 0, the camera at y = 0) " + surface_text(*calibration.wall, origin) + ".\n";
  } else {
    text += "# x, y and yaw are the camera's own: no wall was asked for.\n";
  }
  text += "pose:\n  level: given\n";
  auto const line = [&](char const* key, double value) {
    text += fmt::format("  {}: {:.6f}\n", key, rounded(value, 6));
  };
  line("camera_pitch_rad", camera.pitch_rad);
  line("camera_roll_rad", camera.roll_rad);
  line("camera_height_m", camera.height_m);
  line("camera_yaw_rad", camera.yaw_rad);
  line("camera_x_m", camera.x_m);
  line("camera_y_m", camera.y_m);
  return text;
}

std::vector<std::string> calibration_warnings(Calibration const& calibration,
                                              CalibrationOrigin const& origin) {
  std::vector<std::string> warnings;
  if (calibration.floor.frame_count < origin.frames) {
    warnings.push_back(fmt::format("{} of {} frames show no floor there, and were left out",
                                   origin.frames - calibration.floor.frame_count, origin.frames));
  }
  if (!calibration.spread) {
    warnings.emplace_back("one frame only: nothing tells how sure this is");
    return warnings;
  }
  CameraStand const& spread = *calibration.spread;
  double const angle_deg = degrees(std::max({spread.pitch_rad, spread.roll_rad, spread.yaw_rad}));
  double const length_m = std::max(spread.height_m, spread.x_m);
  if (angle_deg > kMostSpread_deg || length_m > kMostSpread_m) {
    warnings.push_back(fmt::format(
        "the frames differ by {:.2f} degrees and {:.0f} mm: either the camera moved, or too little "
        "of the floor{} is in view",
        angle_deg, 1000.0 * length_m, calibration.wall ? " or the wall" : ""));
  }
  double const lean_deg = std::abs(degrees(calibration.wall_lean_rad));
  if (lean_deg > kMostLean_deg) {
    warnings.push_back(fmt::format(
        "the wall stands {:.1f} degrees off upright: either it is none, or depth is distorted",
        lean_deg));
  }
  return warnings;
}

}  // namespace credo
