#pragma once

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/se3.hpp"

namespace credo {

/// How the two cameras of an RGB-D sensor see and stand; pinhole, no distortion.
struct DepthCalibration {
  CameraIntrinsics depth;
  CameraIntrinsics color;
  Se3 T_color_depth;
};

/// Of a typical Kinect or Xtion at 640x480: the depth camera at 575.8 px, the colour camera at
/// 525 px and 25 mm to its right (seen from behind), both looking the same way. So near things lie
/// further left in the colour image than in the depth image. A single sensor's principal points
/// differ from this by up to about 10 px.
DepthCalibration kinect_calibration();

/// What the depth camera measured, as a depth image [m] of the colour camera, width x height; 0
/// where there is none. Input that is not positive and finite counts as none.
///
/// Each pixel takes its footprint along to where it is seen by the colour camera, and the nearest
/// one wins. Footprints of neighbours on one surface (depth within 3 %) meet halfway: so no holes
/// open where the colour camera sees more finely or a surface is slanted, and nothing behind it
/// shows through. Depth is the pixel's own, not interpolated: the sensor's steps stay. What only
/// the colour camera sees stays empty. Made for cameras side by side, turned by a few degrees.
///
/// A size below zero, or a focal length that is not positive, throws std::logic_error.
Grid<float> register_depth(Grid<float> const& depth_m, DepthCalibration const& calibration,
                           int width, int height);

/// The calibration of images `scale` times as wide and high.
DepthCalibration scaled(DepthCalibration const& calibration, double scale);

}  // namespace credo
