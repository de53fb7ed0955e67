#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/se3.hpp"

namespace credo {

/// A stamp in seconds, as recordings write it; none where it is no time: NaN, or beyond 285 years,
/// which no int64_t of nanoseconds holds.
std::optional<std::int64_t> stamp_from_seconds(double stamp_s);
/// The same of a word. Digits with up to nine behind the point are taken exactly, which a double
/// would not hold after the first 104 days.
std::optional<std::int64_t> stamp_from_text(std::string const& word);

/// What becomes of a last line without an end.
enum class LastLine : std::uint8_t {
  /// It counts like any other.
  kKeep,
  /// Its writer was stopped in the middle of it: it is passed over.
  kDropTorn,
};

/// One camera pose (camera to source) from a file of 16 numbers, 4x4 row by row. Throws InputError
/// for any other count and for what is no rigid motion.
Se3 read_pose(std::filesystem::path const& path);

/// Camera poses over time (TUM) or frame by frame (KITTI).
class Trajectory {
public:
  /// Lines `stamp_s tx ty tz qx qy qz qw` with rising stamps, or 12 or 16 numbers (3x4 or 4x4, row
  /// by row) for each frame; empty lines and lines from # on are passed over. Throws InputError
  /// with the line.
  explicit Trajectory(std::filesystem::path const& path, LastLine last = LastLine::kKeep);

  /// The pose of a frame: by index; or by stamp, interpolated between the two poses around it where
  /// neither is more than 0.1 s away, or the nearest within 0.02 s. None where there is none.
  [[nodiscard]] std::optional<Se3> at(FrameIndex index, std::int64_t stamp_ns) const;

private:
  void add_line(std::vector<double> const& numbers, std::string const& line);
  [[nodiscard]] std::optional<Se3> at_stamp(std::int64_t stamp_ns) const;

  bool by_stamp_ = false;
  std::vector<std::int64_t> stamps_ns_;
  std::vector<Se3> poses_;
};

}  // namespace credo
