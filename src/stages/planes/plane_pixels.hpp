#pragma once

#include <algorithm>
#include <cstddef>

#include "core/cloud.hpp"
#include "core/plane.hpp"
#include "stages/planes/pixel_set.hpp"

namespace credo {

/// How far a point may lie from a plane and still belong to it.
struct PlaneTolerance {
  float fixed_m = 0.0F;
  /// So many standard deviations of a Kinect's axial noise, where that is more.
  float noise_sigmas = 0.0F;
  /// A point with a normal belongs to the plane only where |cos| of the angle between both is at
  /// least this; 0 or less leaves normals out.
  float min_cosine = 0.0F;

  /// Axial noise at depth z [m], one standard deviation: least + growth (z - nearest)^2. Nguyen,
  /// Izadi and Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and Tracking",
  /// 3DIMPVT 2012, equation 4.
  static constexpr float kLeastNoiseM = 0.0012F;
  static constexpr float kNoiseGrowthPerM = 0.0019F;
  static constexpr float kNearestM = 0.4F;

  [[nodiscard]] float distance_m(float depth_m) const {
    float const beyond_m = depth_m - kNearestM;
    return std::max(fixed_m,
                    noise_sigmas * (kLeastNoiseM + kNoiseGrowthPerM * (beyond_m * beyond_m)));
  }
};

/// Those of the pixels `among`, all of them valid in the cloud, that belong to the plane; all in
/// the camera frame. A pixel without a normal is judged by distance alone. The same to the bit on
/// every instruction set.
[[nodiscard]] CountedPixels plane_inliers(Plane const& plane_camera, OrganizedCloud const& cloud,
                                          NormalMap const& normals, PixelSet const& among,
                                          PlaneTolerance const& tolerance);

struct PlanePixels {
  CountedPixels inliers;
  /// Near enough, but their normals are turned too far. None where normals are left out.
  PixelSet turned{0};
};

/// The same, and besides what only its normal keeps out.
[[nodiscard]] PlanePixels plane_pixels(Plane const& plane_camera, OrganizedCloud const& cloud,
                                       NormalMap const& normals, PixelSet const& among,
                                       PlaneTolerance const& tolerance);

/// Those of the pixels `among` that lie clear of the plane, by their tolerance, on the side that
/// its normal does not point to.
[[nodiscard]] CountedPixels pixels_behind(Plane const& plane_camera, OrganizedCloud const& cloud,
                                          PixelSet const& among, PlaneTolerance const& tolerance);

}  // namespace credo
