#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/se3.hpp"
#include "geometry/depth_registration.hpp"
#include "io/image.hpp"
#include "support/literal_registration.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {

inline constexpr int kWidth = 64;
inline constexpr int kHeight = 48;
inline constexpr double kFocal_px = 60.0;

/// Unlike in each pixel and image.
inline Grid<std::uint16_t> depth_of(std::size_t image) {
  Grid<std::uint16_t> depth(kWidth, kHeight);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    depth[i] = static_cast<std::uint16_t>(300 + i + 60 * image);
  }
  depth[{3, 2}] = 0;
  return depth;
}

inline Grid<Rgb> color_of(std::size_t image) {
  Grid<Rgb> color(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      color[{u, v}] = {static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v),
                       static_cast<std::uint8_t>(image)};
    }
  }
  return color;
}

inline std::filesystem::path image_file(std::filesystem::path const& folder, std::size_t image,
                                        char const* kind) {
  char name[32];
  std::snprintf(name, sizeof name, "%04zu.%s.png", image, kind);
  return folder / name;
}

inline void write_dataset(std::filesystem::path const& folder, std::size_t images) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < images; ++i) {
    write_png16(image_file(folder, i, "depth"), depth_of(i));
    write_png_rgb(image_file(folder, i, "color"), color_of(i));
  }
  write_text(folder / "camera-intrinsics.txt", "60 0 31.5 0 60 23.5 0 0 1");
}

/// The obvious way: for each pixel of the infrared camera, 25 mm to the left and with a lens
/// 575.8/525 as long, the nearest of all that lands there.
inline Grid<std::uint16_t> literally_unregistered(Grid<std::uint16_t> const& depth) {
  CameraIntrinsics const color{kFocal_px, kFocal_px, 31.5, 23.5};
  double const infrared_px = kFocal_px * 575.8 / 525.0;
  DepthCalibration const calibration{
      color,
      {infrared_px, infrared_px, 31.5, 23.5},
      Se3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.025, 0.0, 0.0))};
  Grid<float> depth_m(depth.width(), depth.height());
  for (std::size_t p = 0; p < depth.size(); ++p) {
    depth_m[p] = static_cast<float>(depth[p]) / 1000.0F;
  }
  depth_m = literal_registration(depth_m, calibration, depth.width(), depth.height());
  Grid<std::uint16_t> seen(depth.width(), depth.height());
  for (std::size_t p = 0; p < depth.size(); ++p) {
    seen[p] = static_cast<std::uint16_t>(std::lround(1000.0F * depth_m[p]));
  }
  return seen;
}

}  // namespace credo::test
