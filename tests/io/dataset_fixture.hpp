#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <variant>

#include "core/error.hpp"
#include "io/dataset.hpp"
#include "io/image.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {

inline constexpr int kWidth = 32;
inline constexpr int kHeight = 24;

/// Noise compresses badly, so that a cut file misses pixels.
inline Grid<std::uint16_t> some_depth(int width = kWidth, int height = kHeight) {
  Grid<std::uint16_t> depth(width, height);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    depth[i] = static_cast<std::uint16_t>(1000 + (i * 2654435761U >> 7U) % 1000);
  }
  return depth;
}

inline Grid<Rgb> some_color(int width = kWidth, int height = kHeight) {
  Grid<Rgb> color(width, height);
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = {static_cast<std::uint8_t>(i * 37), static_cast<std::uint8_t>(i * 101), 7};
  }
  return color;
}

/// A folder in which a test writes a recording.
class DatasetTest : public testing::Test {
protected:
  /// A file of frame `number` in the layout with poses.
  [[nodiscard]] std::filesystem::path file(int number, std::string const& kind) const {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%06d.", number);
    return folder_ / (name + kind);
  }
  void write_frame(int number) {
    write_png16(file(number, "depth.png"), some_depth());
    write_png_rgb(file(number, "color.png"), some_color());
    write_text(file(number, "pose.txt"), "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
  /// Frames 0 to 2, all good.
  void write_three() {
    for (int i = 0; i < 3; ++i) {
      write_frame(i);
    }
    write_text(folder_ / "camera-intrinsics.txt", "500 0 15.5 0 500 11.5 0 0 1");
  }
  /// Two depth images (d0, d1) and two of colour (c0, c1) for the lists of a TUM recording.
  void write_tum_images() {
    for (std::string const name : {"d0.png", "d1.png"}) {
      write_png16(folder_ / name, some_depth());
    }
    for (std::uint8_t i = 0; i < 2; ++i) {
      write_png_rgb(folder_ / ("c" + std::to_string(i) + ".png"),
                    Grid<Rgb>(kWidth, kHeight, Rgb{i, i, i}));
    }
  }

  [[nodiscard]] OpenedSource open(CaptureConfig const& capture = {},
                                  PoseConfig const& pose = {}) const {
    return open_dataset(folder_.path(), capture, pose);
  }
  /// What open_dataset says, without the folder.
  [[nodiscard]] std::string open_error(PoseConfig const& pose = {}) const {
    try {
      static_cast<void>(open({}, pose));
    } catch (InputError const& error) {
      return without_folder(error.what());
    }
    return "no error";
  }
  [[nodiscard]] std::string without_folder(std::string text) const {
    std::string const folder = folder_.path().string();
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
      text.erase(at, folder.size());
    }
    return text;
  }

  TempFolder folder_;
};

/// The next frame; a test that gets none stops there.
inline FramePtr next_frame(OpenedSource const& opened) {
  SourceResult const result = opened.source->next();
  if (auto const* failure = std::get_if<FrameFailure>(&result)) {
    throw std::runtime_error("no frame but: " + failure->message);
  }
  return std::get<FramePtr>(result);
}

}  // namespace credo::test
