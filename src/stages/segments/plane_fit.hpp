#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace credo::segments {

/// The plane n p = 1 (n in 1/m, camera frame) that fits inverse depths best, which are n ray there.
/// No point is seen from behind, so n points away from the camera.
class PlaneFit {
public:
  /// `ray` has z = 1.
  void add(Eigen::Vector3d const& ray, double per_m) {
    squares_ += ray * ray.transpose();
    products_ += ray * per_m;
  }

  /// Of fewer than three points, or of points in a line, one of those that fit.
  [[nodiscard]] Eigen::Vector3d normal_per_m() const { return squares_.ldlt().solve(products_); }

private:
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d products_ = Eigen::Vector3d::Zero();
};

/// Surfaces that face up within 37 degrees carry what touches them.
inline constexpr double kLevelCosine = 0.8;

/// How far a plane faces up (unit vector, camera frame): 1 where it is level and seen from above.
[[nodiscard]] inline double upward_cosine(Eigen::Vector3d const& normal_per_m,
                                          Eigen::Vector3d const& up_camera) {
  return -normal_per_m.dot(up_camera) / normal_per_m.norm();
}

}  // namespace credo::segments
