#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/frame.hpp"
#include "io/appended_file.hpp"
#include "io/recording_file.hpp"

namespace credo {

/// Writes frames of any source into a folder that open_dataset reads back to the same frames: a TUM
/// RGB-D folder (depth/ and rgb/ as PNG, depth.txt, rgb.txt, groundtruth.txt,
/// camera-intrinsics.txt) with recording.json, which says what a count of depth is and whether
/// colour is registered, and SHA256SUMS, which `sha256sum -c` understands. A frame without colour
/// is one without a line in rgb.txt.
///
/// A frame's images are there before their checksums, and these before its line in depth.txt: a
/// recording that was cut short can be read, and verified, up to the cut. The checksums of the
/// other files come with `finish`.
///
/// The first frame settles the size, the intrinsics and the unit of depth: the first of
/// `depth_unit_m` (where above 0), 1 mm, 0.1 mm and 0.2 mm that holds its depth to the bit.
class RecordingWriter {
public:
  /// Makes the folder. Throws InputError where it is there already, or cannot be made.
  RecordingWriter(std::filesystem::path folder, double depth_unit_m);

  /// Why a frame cannot be part of this recording, one line; none where it can: it has another size
  /// or other intrinsics than the first, or does not come after the one before.
  [[nodiscard]] std::optional<std::string> refusal(Frame const& frame) const;
  /// Throws InputError where a file cannot be written, and leaves nothing half written behind; the
  /// frames before are whole. For a frame that is refused throws std::logic_error.
  void write(Frame const& frame);
  /// Whatever the frames say: the recording's colour is not registered to its depth.
  void deny_color_registered() { color_registered_ = false; }
  /// Closes the recording. A folder without frames is removed again. Throws InputError.
  void finish();

  [[nodiscard]] std::int64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// Frames whose depth is not held to the bit: rounded, or too far.
  [[nodiscard]] std::int64_t rounded_frames() const { return rounded_; }
  [[nodiscard]] double depth_unit_m() const { return info_.depth_unit_m; }

private:
  struct Lists {
    AppendedFile sums;
    AppendedFile depth;
    AppendedFile color;
    AppendedFile poses;
  };

  void begin(Frame const& first);
  void write_small(std::string const& name, std::string const& text);
  /// Returns the name in the folder.
  std::string write_image(std::string const& folder, std::string const& file,
                          std::vector<unsigned char> const& png);

  std::filesystem::path folder_;
  double wanted_unit_m_;
  RecordingInfo info_;
  /// No frame so far said otherwise.
  bool color_registered_ = true;
  std::optional<Lists> lists_;
  CameraIntrinsics intrinsics_;
  int width_ = 0;
  int height_ = 0;
  std::int64_t last_stamp_ns_ = 0;
  std::int64_t frames_ = 0;
  std::uint64_t bytes_ = 0;
  std::int64_t rounded_ = 0;
};

}  // namespace credo
