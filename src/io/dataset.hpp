#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/capture_config.hpp"
#include "core/frame_source.hpp"

namespace credo {

/// A source that was opened, and what a person should know about it.
struct OpenedSource {
  std::unique_ptr<FrameSource> source;
  std::vector<std::string> warnings;
  /// Frames it will deliver, good or bad.
  std::size_t frame_count = 0;
};

/// Opens a folder of recorded RGB-D frames; the layout is told by what lies in it:
///  - `frame-NNNNNN.depth.png`, `.color.jpg|png`, `.pose.txt` (4x4, camera to source), depth in mm
///  - TUM RGB-D: `depth.txt`, `rgb.txt`, `groundtruth.txt`; depth in 1/5000 m; colour by the
///  nearest
///    stamp within 20 ms, poses interpolated
///  - `NNNN.depth.png`, `NNNN.color.png`; depth in mm
///  - organised `*.pcd`, in name order
/// Depth counts 0 and 65535 are invalid. Intrinsics: see find_intrinsics. Poses: as pose.source
/// says; a recording without any stands still. Stamps: TUM's own, else 1/30 s a frame.
///
/// What can be checked at once (folder, intrinsics, trajectory, first frame) throws InputError.
/// Later each bad frame is a FrameFailure with one of these reasons: missing_depth, missing_color,
/// missing_pose, bad_pose, unreadable_image, truncated_image, wrong_size, bad_cloud.
OpenedSource open_dataset(std::filesystem::path const& folder, CaptureConfig const& capture,
                          PoseConfig const& pose);

}  // namespace credo
