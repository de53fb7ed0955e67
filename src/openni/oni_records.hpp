#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace credo {

/// Where one image lies in a recording.
struct OniImage {
  std::uint64_t offset_bytes = 0;
  std::uint32_t size_bytes = 0;
  std::int64_t stamp_ns = 0;
  /// Counts up within its stream.
  std::uint32_t number = 0;
  /// Its bytes are damaged or cut off; only `number` is known.
  bool lost = false;
};

/// One stream of images of a recording.
struct OniStream {
  /// Four letters, such as "16zT", "JPEG" or "NONE".
  std::string codec;
  int width = 0;
  int height = 0;
  std::optional<double> horizontal_fov_rad;
  std::optional<double> vertical_fov_rad;
  /// Left and right are swapped.
  bool mirrored = false;
  /// As the recorder names it: 1 is RGB of 8 bits.
  std::uint64_t pixel_format = 1;
  /// In order of their numbers.
  std::vector<OniImage> images;
};

/// What a recording of OpenNI 1 or 2 (.oni) holds.
struct OniIndex {
  OniStream depth;
  std::optional<OniStream> color;
  /// Where its last record ends; 0 where that does not say that it is the last.
  std::uint64_t end_bytes = 0;
  /// What is damaged or missing, a line each.
  std::vector<std::string> warnings;
};

/// Finds the images of a recording without reading them. Where records are damaged it goes on at
/// the next one that is whole; a file that was cut short, such as one whose recorder was killed,
/// keeps what comes before the cut. Images that are lost in this way keep their places.
///
/// Throws InputError for what is no file, no ONI recording, or has no depth.
OniIndex index_oni(std::filesystem::path const& path);

}  // namespace credo
