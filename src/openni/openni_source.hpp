#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "core/capture_config.hpp"
#include "core/sensor_config.hpp"
#include "io/dataset.hpp"

namespace credo {

/// Takes what a live source has to say to people, one line each, from the thread that reads it: the
/// sensor is back, its clock jumped, its depth is not registered.
using LiveNotes = std::function<void(std::string const&)>;

/// Opens a sensor through OpenNI2, by its URI or, where that is empty, the first one found. A
/// recording's path is a URI, too: OpenNI2 then plays it in real time.
///
/// A frame is a depth image with the colour image nearest in time, within half a frame's time.
/// What is not taken in time is replaced by what is newer, as a live sensor does, and counted. The
/// sensor stands still: pose.source must not be `file`. Mirrored streams are turned back.
/// Intrinsics: the config's, else of the field of view. Stamps: the sensor's clock, which goes on
/// for ever (DeviceClock), also through an unplugging.
///
/// Ends on `stop`, and where a recording ends. Throws InputError where there is no such sensor.
/// Later it goes on whatever the sensor does, and tells as a FrameFailure
///  - stalled, silence: no depth for sensor.stall_s (sensor.first_frame_s before the first); after
///    three in a row the sensor is opened anew
///  - unplugged, away, silence: it has gone, and is looked for
///  - missed: the sensor numbered an image that did not come
///  - broken_image: a depth image that is not whole
/// One such source at a time.
OpenedSource open_openni(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose, SensorConfig const& sensor, LiveNotes notes,
                         std::stop_token stop);

}  // namespace credo
