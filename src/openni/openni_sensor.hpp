#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/sensor_config.hpp"
#include "openni/sensor_image.hpp"

namespace credo {

/// What came of waiting for a sensor's next image.
struct SensorImage {
  enum class Kind : std::uint8_t {
    /// Nothing in time.
    kNone,
    kDepth,
    kColor,
    /// A depth image that is not whole.
    kBroken,
    /// The sensor has gone, and does not come back by itself.
    kUnplugged,
    /// A recording that is played has ended.
    kEnd,
  };
  Kind kind = Kind::kNone;
  /// Of the sensor's clock.
  std::uint64_t stamp_us = 0;
  std::chrono::steady_clock::time_point arrival;
  /// Counts up within its stream, images that nobody took included.
  int number = 0;
  Grid<std::uint16_t> counts;
  Grid<Rgb> color;
  /// What OpenNI2 said; may be empty.
  std::string why;
};

/// One sensor as OpenNI2 opens it, from the opening until it goes. Mirrored streams are turned
/// back. Colour is RGB of the depth's size, or there is none. All calls from one thread.
class OpenniSensor {
public:
  /// `uri` empty: the first sensor found. Throws InputError where there is none, or it has no
  /// depth.
  OpenniSensor(std::string const& uri, SensorConfig const& config);
  OpenniSensor(OpenniSensor const&) = delete;
  OpenniSensor& operator=(OpenniSensor const&) = delete;
  OpenniSensor(OpenniSensor&&) = delete;
  OpenniSensor& operator=(OpenniSensor&&) = delete;
  ~OpenniSensor();

  [[nodiscard]] std::string const& uri() const;
  [[nodiscard]] DepthOptics optics() const;
  [[nodiscard]] bool has_color() const;
  /// Of the colour camera; only where there is one.
  [[nodiscard]] DepthOptics color_optics() const;
  /// Of the modes in which the streams run; colour's only where there is one.
  [[nodiscard]] int depth_rate_hz() const;
  [[nodiscard]] int color_rate_hz() const;
  /// A recording that OpenNI2 plays: of registration it knows nothing.
  [[nodiscard]] bool is_recording() const;
  /// Whether the sensor says that its depth is registered to its colour camera; asked anew.
  [[nodiscard]] bool says_registered() const;
  /// What was asked for and could not be had, one line each.
  [[nodiscard]] std::vector<std::string> const& warnings() const;

  /// Waits so long at most.
  SensorImage next(std::chrono::milliseconds most);
  /// Stops colour and starts it again, with its settings; false where it does not start.
  bool restart_color();

  /// Has OpenNI2's recorder write what the streams give into a file, without loss, whether `next`
  /// takes it or not. Throws InputError where it does not begin.
  void start_recording(std::filesystem::path const& file);
  /// Stops the streams, too.
  void stop_recording();

private:
  class Open;
  std::unique_ptr<Open> open_;
};

/// OpenNI2, as long as it is needed. Throws InputError where it does not start.
class OpenniLibrary {
public:
  OpenniLibrary();
  OpenniLibrary(OpenniLibrary const&) = delete;
  OpenniLibrary& operator=(OpenniLibrary const&) = delete;
  OpenniLibrary(OpenniLibrary&&) = delete;
  OpenniLibrary& operator=(OpenniLibrary&&) = delete;
  ~OpenniLibrary();
};

}  // namespace credo
