#include "end_to_end/floor_dataset.hpp"

#include <cstdint>
#include <cstdio>
#include <sstream>

#include "core/frame.hpp"
#include "io/image.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 80;
constexpr int kHeight = 60;
constexpr double kFocalPx = 60.0;
constexpr int kFirstFloorRow = 35;

/// Depth of the floor in a row below the horizon.
double depth_m(int v) {
  return kFocalPx / (v - kHeight / 2);
}

std::string numbered(char const* format, int number) {
  char name[32];
  std::snprintf(name, sizeof name, format, number);
  return name;
}

}  // namespace

fs::path frame_file(fs::path const& folder, int frame, std::string const& kind) {
  return folder / (numbered("frame-%06d.", frame) + kind);
}

void write_floor_dataset(fs::path const& folder, int frames) {
  fs::create_directories(folder);
  write_text(folder / "camera-intrinsics.txt", "60 0 40\n0 60 30\n0 0 1\n");
  Grid<std::uint16_t> depth_mm(kWidth, kHeight);
  for (int v = kFirstFloorRow; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      depth_mm[Pixel{u, v}] = static_cast<std::uint16_t>(depth_m(v) * 1000.0);
    }
  }
  EncodedPng const depth = encode_png16(depth_mm);
  EncodedPng const color = encode_png_rgb(Grid<Rgb>(kWidth, kHeight));
  for (int i = 0; i < frames; ++i) {
    write_bytes(frame_file(folder, i, "depth.png"), depth);
    write_bytes(frame_file(folder, i, "color.png"), color);
    write_text(frame_file(folder, i, "pose.txt"), "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
}

void write_floor_clouds(fs::path const& folder, int frames) {
  fs::create_directories(folder);
  std::ostringstream cloud;
  cloud << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << kWidth
        << "\nHEIGHT " << kHeight << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << kWidth * kHeight
        << "\nDATA ascii\n";
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (v < kFirstFloorRow) {
        cloud << "nan nan nan\n";
      } else {
        cloud << (u - kWidth / 2) / kFocalPx * depth_m(v) << " 1 " << depth_m(v) << '\n';
      }
    }
  }
  for (int i = 0; i < frames; ++i) {
    write_text(folder / numbered("%04d.pcd", i), cloud.str());
  }
}

}  // namespace credo::test
