#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "geometry/bingham/bingham.hpp"

namespace credo {

/// No fit is more concentrated than this: about 0.26 degrees. A single rotation comes to it.
inline constexpr double kLeastFittedConcentration = -1e5;

/// E[q q^T] (w, x, y, z), of trace 1.
[[nodiscard]] Eigen::Matrix4d scatter_of(Bingham const& distribution);

/// The distribution of greatest likelihood for quaternions of this scatter: the one whose own
/// scatter it is. Any positive multiple of a scatter will do. Throws std::logic_error where it is
/// not finite or has no positive trace.
[[nodiscard]] Bingham fit_to_scatter(Eigen::Matrix4d const& scatter);

/// From weighted rotations, q and -q being one; a fit to none, or to none with weight, is uniform.
/// Throws std::logic_error for other than one weight a rotation, a negative weight, or NaN.
[[nodiscard]] Bingham fit_bingham(std::span<Eigen::Quaterniond const> rotations,
                                  std::span<double const> weights);
/// All weights one.
[[nodiscard]] Bingham fit_bingham(std::span<Eigen::Quaterniond const> rotations);

/// The distribution of a (x) b, a and b independent. It is no Bingham distribution: this is the one
/// with its second moments.
[[nodiscard]] Bingham composition(Bingham const& a, Bingham const& b);

}  // namespace credo
