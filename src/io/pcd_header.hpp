#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace credo {

enum class PcdData : std::uint8_t { kAscii, kBinary, kCompressed };

/// What a PCD file says of itself (format 0.7 as PCL documents it).
struct PcdHeader {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t points = 0;
  std::size_t values_per_point = 0;
  std::size_t bytes_per_point = 0;
  PcdData data = PcdData::kAscii;
  /// Bytes from the start of the file to the first point.
  std::size_t data_start = 0;
};

/// Reads the header of an organised cloud and holds the length of the file against it. PCL's reader
/// trusts the header: where header and data do not fit, it writes past its buffers or goes on in
/// silence. Throws InputError: no such file, no or damaged header, not organised, cut short.
PcdHeader read_pcd_header(std::filesystem::path const& path);
/// The same of any cloud, organised or not.
PcdHeader read_any_pcd_header(std::filesystem::path const& path);

}  // namespace credo
