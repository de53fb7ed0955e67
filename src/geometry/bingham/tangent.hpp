#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "geometry/bingham/bingham.hpp"

namespace credo {

/// Where a rotation errs little, it is the mode and a small turn phi [rad]: R = R_mode exp(phi)
/// along the axes of the body, R = exp(phi) R_mode along those of the world (the frame in which the
/// rotation is given; boxplus of core/se3.hpp). The covariance of phi is 4 E[(v_i . q)^2] along
/// the turn that leads to v_i: within 5 % up to deviations of 0.4 rad, and too little beyond, as
/// an angle is more than twice its half's sine (at most 4 rad^2 in all). Then hand on the
/// distribution itself.
[[nodiscard]] Eigen::Matrix3d tangent_covariance_body_rad2(Bingham const& distribution);
[[nodiscard]] Eigen::Matrix3d tangent_covariance_world_rad2(Bingham const& distribution);
/// Whether every deviation is below 0.4 rad.
[[nodiscard]] bool is_tangent_covariance_valid(Bingham const& distribution);

/// The other direction: the distribution with the same density around its mode as a normal one, so
/// that products add the same information; z = -2 / variance. No variance is taken as less than
/// 2e-9 rad^2. Throws std::logic_error where the covariance is not finite or a variance is
/// negative.
[[nodiscard]] Bingham bingham_of_body_covariance(Eigen::Quaterniond const& mode,
                                                 Eigen::Matrix3d const& covariance_rad2);
[[nodiscard]] Bingham bingham_of_world_covariance(Eigen::Quaterniond const& mode,
                                                  Eigen::Matrix3d const& covariance_rad2);

}  // namespace credo
