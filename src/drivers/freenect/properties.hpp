#pragma once

namespace credo::freenect {

// Properties of this driver's streams beside OpenNI's own: an int each, to be read. What went wrong
// with the stream since its Kinect was opened.
/// Packets that did not come.
inline constexpr int kLostPacketsProperty = 0x4B310001;
/// Frames given up, as too many of their packets did not come.
inline constexpr int kDroppedFramesProperty = 0x4B310002;
/// How often the stream was silent for 2 s, and was started anew.
inline constexpr int kStallsProperty = 0x4B310003;

}  // namespace credo::freenect
