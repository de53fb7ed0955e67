#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "core/plane.hpp"

namespace credo {

/// The plane through points that a depth camera measured: each is exact in its direction and errs
/// along its ray, with the same standard deviation in inverse depth whatever the distance, as
/// sensors that triangulate do.
///
/// A plane n . p = d is affine in inverse depth: with p = z ray, a = n / d and w = 1 / z it says
/// a . ray = w. Least squares on a . ray - w is therefore linear and unbiased, where least squares
/// on distances would lean towards the ray for grazing planes. It is the same as to weigh the
/// squared distance of each point by 1 / (z d)^2, the inverse variance of a distance that comes of
/// an error k z^2 in depth.
///
/// Sums only: those of many frames add up to the fit of all their points. Camera frame, doubles.
class RayPlaneFit {
public:
  /// `point` lies before the camera, z > 0.
  void add(Eigen::Vector3d const& point);
  void add(RayPlaneFit const& other);
  [[nodiscard]] std::size_t point_count() const { return count_; }

  /// The normal faces the camera, so that its offset is negative. None where the points do not span
  /// a plane, or one through the camera.
  [[nodiscard]] std::optional<Plane> plane() const;
  /// The same among planes that hold the direction `along` (unit): walls, where it is up.
  [[nodiscard]] std::optional<Plane> plane_along(Eigen::Vector3d const& along) const;

private:
  Eigen::Matrix3d rays_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rays_inverse_depth_ = Eigen::Vector3d::Zero();
  std::size_t count_ = 0;
};

/// How far a point is off the plane in inverse depth [1/m], positive before it: its error along the
/// ray in the sensor's own measure. Infinite for a plane through the camera.
double inverse_depth_error_per_m(Plane const& plane, Eigen::Vector3d const& point);

}  // namespace credo
