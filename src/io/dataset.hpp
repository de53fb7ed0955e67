#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/capture_config.hpp"
#include "core/frame_source.hpp"

namespace credo {

/// A source that was opened, and what a person should know about it.
struct OpenedSource {
  std::unique_ptr<FrameSource> source;
  std::vector<std::string> warnings;
  /// Frames it will deliver, good or bad; none where the end is not known.
  std::optional<std::size_t> frame_count;
};

/// Opens a folder of recorded RGB-D frames; the layout is told by what lies in it:
///  - `frame-NNNNNN.depth.png`, `.color.jpg|png`, `.pose.txt` (4x4, camera to source), depth in mm
///  - TUM RGB-D: `depth.txt`, `rgb.txt`, `groundtruth.txt`; depth in 1/5000 m; a frame per depth
///    image, with the colour nearest in time within 20 ms and the pose interpolated
///  - the same with `recording.json`: what RecordingWriter wrote, to be read back as it was
///  - `NNNN.depth.png`, `NNNN.color.png|jpg`, from any number; depth in mm
///  - organised `*.pcd`, in name order; the sensor pose in their headers is not used
/// Depth counts 0 and 65535 are invalid. Intrinsics: see find_intrinsics. Poses: as pose.source
/// says; a recording without any stands still. Stamps: TUM's own, else 1/30 s a frame. A gap in the
/// numbers is no frame (see list_dataset).
///
/// Where the folder has a SHA256SUMS, each file that it names is verified when it is read; a file
/// that it does not name is not.
///
/// What can be checked at once (folder, intrinsics, trajectory, lists, first frame) throws
/// InputError.
/// Later each bad frame is a FrameFailure with one of these reasons:
///  - checksum: a file of it is not as SHA256SUMS says, or named there and gone; the first frame,
///    too
///  - missing_depth, missing_color, missing_pose: the file, or its like in time, is not there
///  - unreadable_image: no image, damaged, of the wrong kind; truncated_image: its end is missing
///  - wrong_size: colour unlike its depth, or depth or cloud unlike the first frame
///  - bad_pose: not 16 numbers, not finite, not a rigid motion
///  - bad_cloud: PCD without x y z, not organised, damaged or cut short
OpenedSource open_dataset(std::filesystem::path const& folder, CaptureConfig const& capture,
                          PoseConfig const& pose);

}  // namespace credo
