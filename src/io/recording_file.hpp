#pragma once

#include <filesystem>
#include <optional>

namespace credo {

/// What a recording says of itself beside a TUM folder's files, in recording.json.
struct RecordingInfo {
  /// Metres per count of its depth images.
  double depth_unit_m = 0.001;
  bool color_registered = false;
};

inline constexpr char const* kRecordingFile = "recording.json";

/// None where the folder has no recording.json. Throws InputError where it is not as it must be.
std::optional<RecordingInfo> read_recording_info(std::filesystem::path const& folder);
/// In the place of the one that is there, which stays where this one cannot be written. Throws
/// InputError then.
void write_recording_info(std::filesystem::path const& folder, RecordingInfo const& info);

}  // namespace credo
