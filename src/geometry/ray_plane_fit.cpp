#include "geometry/ray_plane_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace credo {
namespace {

/// a = n / d, the side of the normal turned to the camera.
std::optional<Plane> plane_of(Eigen::Vector3d const& a) {
  double const length = a.norm();
  if (!std::isfinite(length) || length < 1e-9) {
    return std::nullopt;
  }
  return Plane{-a / length, -1.0 / length};
}

/// The solution of normal equations that have one, scaled so that the unit of no unknown matters.
template <int N>
std::optional<Eigen::Matrix<double, N, 1>> solution(Eigen::Matrix<double, N, N> const& squares,
                                                    Eigen::Matrix<double, N, 1> const& right) {
  constexpr double kLeastShare = 1e-12;
  Eigen::LDLT<Eigen::Matrix<double, N, N>> const factors(squares);
  auto const d = factors.vectorD();
  if (factors.info() != Eigen::Success || !(d.minCoeff() > kLeastShare * d.maxCoeff())) {
    return std::nullopt;
  }
  return factors.solve(right);
}

}  // namespace

void RayPlaneFit::add(Eigen::Vector3d const& point) {
  double const inverse_depth = 1.0 / point.z();
  Eigen::Vector3d const ray = inverse_depth * point;
  rays_ += ray * ray.transpose();
  rays_inverse_depth_ += inverse_depth * ray;
  ++count_;
}

void RayPlaneFit::add(RayPlaneFit const& other) {
  rays_ += other.rays_;
  rays_inverse_depth_ += other.rays_inverse_depth_;
  count_ += other.count_;
}

std::optional<Plane> RayPlaneFit::plane() const {
  auto const a = solution<3>(rays_, rays_inverse_depth_);
  return a ? plane_of(*a) : std::nullopt;
}

std::optional<Plane> RayPlaneFit::plane_along(Eigen::Vector3d const& along) const {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = along.unitOrthogonal();
  across.col(1) = along.cross(across.col(0));
  Eigen::Matrix2d const squares = across.transpose() * rays_ * across;
  Eigen::Vector2d const right = across.transpose() * rays_inverse_depth_;
  auto const a = solution<2>(squares, right);
  return a ? plane_of(across * *a) : std::nullopt;
}

double inverse_depth_error_per_m(Plane const& plane, Eigen::Vector3d const& point) {
  return (1.0 - plane.normal.dot(point) / plane.offset_m) / point.z();
}

}  // namespace credo
