#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"

namespace credo {

/// Depth counts as they come from a sensor.
struct DepthImage {
  /// Of the sensor's clock, made continuous.
  std::int64_t stamp_ns = 0;
  std::chrono::steady_clock::time_point arrival;
  Grid<std::uint16_t> counts;
};

struct ColorImage {
  std::int64_t stamp_ns = 0;
  Grid<Rgb> image;
};

/// A depth image with the colour image nearest in time; that is empty where none is near.
struct ImagePair {
  DepthImage depth;
  Grid<Rgb> color;
};

/// Pairs the images of two streams by their stamps. A sensor's own synchronisation is not trusted,
/// and depth never waits for colour longer than half a frame's time: what is farther apart is
/// another frame's.
class ImagePairing {
public:
  /// Half a frame's time at 30 Hz.
  static constexpr std::chrono::nanoseconds kNear{1'000'000'000 / 30 / 2};

  /// Without colour depth waits for nothing.
  void expect_color(bool expected) { color_expected_ = expected; }

  void add(ColorImage color);
  /// A depth image that still waits for its colour is done.
  void add(DepthImage depth);

  /// The next pair; none while the depth's colour may still come.
  std::optional<ImagePair> take();
  /// The same, without waiting longer.
  std::optional<ImagePair> take_now();

  [[nodiscard]] bool is_waiting() const { return waiting_.has_value(); }
  /// Nothing that has come is of use any longer.
  void clear();

private:
  [[nodiscard]] ImagePair paired(DepthImage depth);

  bool color_expected_ = true;
  std::vector<ColorImage> colors_;
  std::optional<DepthImage> waiting_;
  std::optional<ImagePair> done_;
};

}  // namespace credo
