#pragma once

#include "core/cloud.hpp"
#include "core/fields.hpp"
#include "core/frame.hpp"

namespace credo {

struct NormalsConfig {
  /// Half the width of the neighbourhood that a normal is fitted to.
  float radius_m = 0.03F;
  /// Bounds of that half width in the image: a far surface is never judged by fewer pixels, a close
  /// one never costs more. Where they contradict each other the greatest wins.
  float min_radius_px = 6.0F;
  float max_radius_px = 40.0F;
  /// A neighbour belongs to the same surface when its depth differs by less than
  /// max_depth_jump_m + depth_noise_per_m z^2: sensors that triangulate scatter evenly in inverse
  /// depth. A tenth of this, as a standard deviation, counts as noise of a flat surface.
  float max_depth_jump_m = 0.02F;
  float depth_noise_per_m = 0.008F;
  /// Least share of the neighbourhood that must belong to the surface.
  float min_support = 0.15F;
};
FieldList fields(NormalsConfig& config);

/// One unit normal per pixel in the camera frame, facing the camera; NaN where depth is invalid or
/// the neighbourhood does not carry a plane (too few pixels of the same surface, or all in a line).
///
/// Method. In inverse depth w = 1/z a plane is exactly affine in the pixel: w = a u + b v + c has
/// the normal -(a fx, b fy, c + a cx + b cy) (Poppinga et al., "Fast Plane Detection and
/// Polygonalization in Noisy 3D Range Images", IROS 2008, fit planes to range images alike).
/// Pixels are averaged in blocks of 2x2, each split where depth jumps inside it. Around each block
/// at most 9x9 samples (means over 1, 2 or 4 blocks a side, so that the square covers radius_m
/// around the point whatever its depth) are fitted by least squares, those alone whose depth
/// matches the block's. Where one plane does not explain them, only the quadrants that lie flat
/// are fitted: normals stay sharp beside creases and steps, and smooth on rounded surfaces.
///
/// The thesis takes PCL's normal of all points within a radius (total least squares in 3-D). Ours
/// is ordinary least squares along the ray, where the sensor's noise is; the neighbourhood is a
/// square in the image instead of a ball; and it neither blends the two sides of a crease nor
/// shrinks below min_radius_px. Away from edges the two agree within noise.
///
/// Only the depths `cloud.z` and the intrinsics are read: for clouds whose x and y deviate from the
/// pinhole model (registered or rectified elsewhere) the normals are those of the depth image.
/// Depths below 1 mm or beyond 1000 km count as invalid. An empty cloud gives an empty map. Focal
/// lengths that are not positive throw std::logic_error. The result is the same to the bit at any
/// thread count and on any instruction set.
NormalMap estimate_normals(OrganizedCloud const& cloud, CameraIntrinsics const& intrinsics,
                           NormalsConfig const& config);

}  // namespace credo
