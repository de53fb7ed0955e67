#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "core/cloud.hpp"
#include "core/plane.hpp"
#include "core/se3.hpp"
#include "stages/planes/pixel_boxes.hpp"
#include "stages/planes/pixel_set.hpp"
#include "stages/planes/plane_pixels.hpp"
#include "stages/planes/planes.hpp"
#include "stages/planes/segment_pieces.hpp"

namespace credo {

/// What every step looks at. Planes are searched for where the depths are: in the camera frame.
struct PlaneView {
  OrganizedCloud const& cloud;
  NormalMap const& normals;
  Se3 const& T_world_camera;
  /// Else nothing is floor.
  bool floor_at_zero;
  float focal_px;
  PlanesConfig const& config;
  PlaneTolerance tolerance;
  PixelBoxes boxes;
  SegmentPieces pieces;
  /// All pixels with depth.
  CountedPixels valid;
};

/// Those of the pixels that belong to a plane.
[[nodiscard]] inline CountedPixels inliers_among(PlaneView const& view, Plane const& plane_camera,
                                                 PixelSet const& pixels,
                                                 PlaneTolerance const& tolerance) {
  return plane_inliers(plane_camera, view.cloud, view.normals,
                       view.boxes.near(plane_camera, pixels, tolerance), tolerance);
}

/// Of all pixels with depth, those that lie clear of the plane on the side that its normal does not
/// point to.
[[nodiscard]] inline CountedPixels pixels_clear_behind(PlaneView const& view,
                                                       Plane const& plane_camera) {
  auto [behind, open] = view.boxes.behind(plane_camera, view.valid.pixels, view.tolerance);
  behind.insert(pixels_behind(plane_camera, view.cloud, open, view.tolerance));
  return behind;
}

/// What belongs to a plane, and what only its normal keeps out.
[[nodiscard]] inline PlanePixels plane_pixels_among(PlaneView const& view,
                                                    Plane const& plane_camera,
                                                    PixelSet const& pixels) {
  return plane_pixels(plane_camera, view.cloud, view.normals,
                      view.boxes.near(plane_camera, pixels, view.tolerance), view.tolerance);
}

/// A plane with its pixels.
struct PixelPlane {
  Plane camera;
  /// The same plane in the world frame.
  Plane world;
  CountedPixels inliers;
  /// Near enough to be its, but for their normals.
  PixelSet turned{0};
  /// May be near to it besides: what another plane had, and what it has given back.
  PixelSet open{0};
  /// More pixels of its segments, not so exactly in the plane.
  CountedPixels joined{PixelSet(0), 0};
};

/// What is near enough to a plane for a pixel whose segment the plane holds anyway: three times the
/// distance, but noise alone takes few points beyond six of its sigmas.
[[nodiscard]] inline PlaneTolerance near_tolerance(PlaneTolerance const& tolerance,
                                                   float min_cosine) {
  return {3.0F * tolerance.fixed_m, 1.5F * tolerance.noise_sigmas, min_cosine};
}

/// Vectors in three arrays: an image's, or a sample's.
struct VectorColumns {
  float const* x;
  float const* y;
  float const* z;

  [[nodiscard]] static VectorColumns of(VectorGrid const& grid) {
    return {grid.x.data(), grid.y.data(), grid.z.data()};
  }
  [[nodiscard]] Eigen::Vector3f at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Height above z = 0 of a point.
class Heights {
public:
  Heights(PlaneView const& view, VectorColumns const& points)
      : points_(points),
        up_(view.T_world_camera.rotation().toRotationMatrix().row(2).cast<float>()),
        camera_m_(static_cast<float>(view.T_world_camera.translation().z())) {}
  /// Of pixels.
  explicit Heights(PlaneView const& view) : Heights(view, VectorColumns::of(view.cloud)) {}

  [[nodiscard]] float operator()(std::size_t i) const { return up_.dot(points_.at(i)) + camera_m_; }

private:
  VectorColumns points_;
  Eigen::Vector3f up_;
  float camera_m_;
};

}  // namespace credo
