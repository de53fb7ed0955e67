#pragma once

#include <cstdint>
#include <string>

#include "core/frame.hpp"

namespace credo {

// What lies in a TUM RGB-D folder, as text.

/// Of the images of a frame: "000012.png".
std::string tum_image_name(FrameIndex frame);
/// Seconds with nine digits behind the point. Not for times before 0.
std::string tum_stamp(std::int64_t stamp_ns);
/// A line of groundtruth.txt without its end; it reads back to the same bits.
std::string tum_pose(std::int64_t stamp_ns, Se3 const& T_source_camera);
/// A camera-intrinsics.txt; it reads back to the same bits.
std::string intrinsics_text(CameraIntrinsics const& k);

}  // namespace credo
