#pragma once

#include <stop_token>
#include <string>

#include "core/capture_config.hpp"
#include "io/dataset.hpp"

namespace credo {

/// Opens a sensor through OpenNI2, by its URI or, where that is empty, the first one found. A
/// recording's path is a URI, too: OpenNI2 then plays it in real time.
///
/// A frame is a depth image with the colour image nearest in time, within half a frame's time.
/// What is not taken in time is replaced by what is newer, as a live sensor does. The sensor stands
/// still: pose.source must not be `file`. Depth is registered to the colour camera where the sensor
/// can; mirrored streams are turned back. Intrinsics: the config's, else of the field of view.
///
/// Ends on `stop`, and where a recording ends. Throws InputError where there is no such sensor.
/// Later:
///  - FrameFailure "stalled", silence: no depth for 2 s (10 s before the first)
///  - InputError once the sensor is unplugged
/// One such source at a time.
OpenedSource open_openni(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose, std::stop_token stop);

}  // namespace credo
