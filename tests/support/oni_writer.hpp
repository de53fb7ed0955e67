#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace credo::test {

/// What a small recording is made of; the images are the caller's.
struct OniScript {
  int width = 0;
  int height = 0;
  std::string depth_codec = "NONE";
  std::string color_codec = "NONE";
  bool mirrored = false;
  double fov_rad = 1.0;
  /// Packed as their codec says; as many of one as of the other, or no colour.
  std::vector<std::string> depth_images;
  std::vector<std::string> color_images;
  std::int64_t color_delay_us = 0;
};

/// An ONI recording at 30 Hz, as OpenNI's recorders write it but without seek tables.
std::string oni_bytes(OniScript const& script);

/// Counts as they lie in memory.
std::string packed(std::vector<std::uint16_t> const& counts);

}  // namespace credo::test
