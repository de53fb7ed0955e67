#pragma once

#include <filesystem>

#include "core/capture_config.hpp"
#include "io/dataset.hpp"

namespace credo {

/// Opens a recording of OpenNI 1 or 2 (.oni) with a depth stream (packed as 16z, 16zT or not) and
/// perhaps a colour stream (JPEG, or RGB of 8 bits).
///
/// A frame is a depth image with the colour image nearest in time, within half a frame's time;
/// without colour where there is none. Streams that were recorded mirrored are turned back. Stamps
/// are the recording's. Intrinsics: the config's, else of the recorded field of view. Poses: of
/// pose.file, else the sensor stands still.
///
/// A long gap of lost images ends a run as other failures in a row do
/// (graph.max_consecutive_failures).
///
/// Throws InputError as index_oni and check_oni_checksum do, and where the config does not fit.
/// Later each bad frame is a FrameFailure:
///  - lost_image: its bytes are damaged or cut off
///  - unreadable_image: depth that does not come out at its size, colour that is no image
///  - missing_pose: pose.file has none for its time
OpenedSource open_oni(std::filesystem::path const& path, CaptureConfig const& capture,
                      PoseConfig const& pose);

}  // namespace credo
