#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "io/image.hpp"
#include "io/pcd.hpp"
#include "support/recordings.hpp"

namespace credo::test {

inline constexpr double kTableTopFocal_px = 525.0;
inline constexpr double kKitchenFocal_px = 585.0;

/// The clouds of OSD, by name.
inline std::vector<std::filesystem::path> table_tops() {
  std::vector<std::filesystem::path> files;
  for (auto const& entry : std::filesystem::directory_iterator(recordings() / "osd")) {
    if (entry.path().extension() == ".pcd") {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

inline Grid<float> table_top_depth_m(std::filesystem::path const& file) {
  constexpr double kFarthest_m = 10.0;
  return read_pcd(file, CloudAxes::kOptical, kFarthest_m).cloud_camera.z;
}

/// Frame `number`, six digits, of the kitchen.
inline Grid<float> kitchen_depth_m(std::string const& number) {
  Grid<std::uint16_t> const counts =
      read_png16(recordings() / "kitchen" / ("frame-" + number + ".depth.png"));
  Grid<float> depth_m(counts.width(), counts.height());
  std::ranges::transform(counts, depth_m.begin(), [](std::uint16_t mm) {
    return mm == 65535 ? 0.0F : static_cast<float>(mm) * 0.001F;
  });
  return depth_m;
}

}  // namespace credo::test
