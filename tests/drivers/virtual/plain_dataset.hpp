#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "io/image.hpp"
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

/// The obvious way: for each pixel of the infrared camera, the nearest of what lands there. The
/// camera stands 25 mm to the left, so all is seen farther to the right.
inline Grid<std::uint16_t> literally_unregistered(Grid<std::uint16_t> const& depth) {
  Grid<std::uint16_t> seen(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      int nearest = 0;
      for (int from = 0; from < depth.width(); ++from) {
        int const z = depth[{from, v}];
        double const x_mm = z * from / kFocal_px + 25.0;
        bool const here = z > 0 && static_cast<int>(std::lround(x_mm * kFocal_px / z)) == u;
        nearest = here && (nearest == 0 || z < nearest) ? z : nearest;
      }
      seen[{u, v}] = static_cast<std::uint16_t>(nearest);
    }
  }
  return seen;
}

}  // namespace credo::test
