#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/se3.hpp"
#include "io/checksums.hpp"

namespace credo {

/// The files of one frame; an empty path is a file that should be there and is not.
struct DatasetEntry {
  std::int64_t stamp_ns = 0;
  std::filesystem::path depth;
  std::filesystem::path color;
  /// Set instead of depth and colour.
  std::filesystem::path cloud;
  std::filesystem::path pose_file;
  /// Where poses come from a trajectory.
  std::optional<Se3> pose;
};

/// What a folder holds, in the order of its frames.
struct DatasetListing {
  std::vector<DatasetEntry> entries;
  double depth_unit_m = 0.001;
  /// Some frame has a pose: then every frame must.
  bool has_poses = false;
  /// The layout has colour registered to depth.
  bool color_registered = false;
  /// A frame without a colour image is one without colour, and not one whose colour is missing.
  bool color_may_lack = false;
  /// What a person should know about the recording.
  std::vector<std::string> warnings;
};

/// Tells the layout of a folder and lists its frames. A number that has neither depth nor colour is
/// a gap, not a frame. The streams of a TUM recording do not start together: depth images before
/// the first with colour and pose are no frames either, and are told as a warning. A TUM folder
/// with a recording.json is of RecordingWriter: each depth image is a frame, with the colour image
/// of its very stamp, if there is one; where it was cut short, what is whole counts. Files that
/// `sums` lists are listed also where they are not there. Throws InputError: no folder, nothing
/// known in it, damaged lists.
DatasetListing list_dataset(std::filesystem::path const& folder, Checksums const& sums = {});

}  // namespace credo
