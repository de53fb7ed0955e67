#pragma once

#include <libfreenect.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/freenect/log_lines.hpp"

namespace credo::freenect {

inline constexpr int kWidth_px = 640;
inline constexpr int kHeight_px = 480;

/// A Kinect does not do what it was asked for; says why.
class KinectError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// What comes of an open Kinect, from within process().
struct KinectEvents {
  /// Millimetres as libfreenect has them: not cleaned. Stamp of the device's clock.
  std::function<void(std::span<std::uint16_t const> depths_mm, std::uint32_t stamp)> depth;
  std::function<void(std::span<std::uint8_t const> rgb, std::uint32_t stamp)> color;
  /// A line of libfreenect's log; whether it tells of something wrong.
  std::function<void(std::string_view line, bool wrong)> log;
};

enum class Automatic : std::uint8_t { kExposure, kWhiteBalance };

/// One Kinect's camera, opened through libfreenect by a context of its own. libfreenect has no
/// locks: everything, from construction to destruction, on one thread, and nothing from an event.
class OpenKinect {
public:
  /// Throws KinectError.
  OpenKinect(std::string const& serial, KinectEvents events);
  OpenKinect(OpenKinect const&) = delete;
  OpenKinect& operator=(OpenKinect const&) = delete;
  OpenKinect(OpenKinect&&) = delete;
  OpenKinect& operator=(OpenKinect&&) = delete;
  ~OpenKinect();

  /// `registered`: depth in the colour camera's image; of no concern to colour. Throws KinectError.
  /// A Kinect that was just unplugged starts well, and sends nothing.
  void start(StreamKind kind, bool registered);
  /// Nothing where it does not run.
  void stop(StreamKind kind);
  /// Takes effect only while colour runs. Throws KinectError.
  void set_automatic(Automatic which, bool on);
  /// Waits so long for events and handles them; false once the Kinect is gone.
  bool process(std::chrono::milliseconds patience);
  /// See false_depths_mm().
  [[nodiscard]] std::vector<std::uint16_t> false_depths() const;

private:
  void open(std::string const& serial);

  KinectEvents events_;
  freenect_context* context_ = nullptr;
  freenect_device* device_ = nullptr;
};

}  // namespace credo::freenect
