#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/se3.hpp"

namespace credo {

// Poses that others tell, in a file or over the network: checked, because an absurd one would be
// believed. Each throws std::invalid_argument that says what it must be.

/// Within 10 km, and finite.
[[nodiscard]] Eigen::Vector3d told_position(Eigen::Vector3d const& position_m);

/// Of length 1 within a per cent; as it was told.
[[nodiscard]] Eigen::Quaterniond told_orientation(Eigen::Quaterniond const& orientation);

/// Of (delta [m], phi [rad]): symmetric but for rounding, positive definite, standard deviations in
/// [1e-6, 1000]. Comes back symmetric to the bit.
[[nodiscard]] Matrix6d told_covariance(Matrix6d const& covariance);

}  // namespace credo
