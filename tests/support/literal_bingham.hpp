#pragma once

#include <Eigen/Core>

namespace credo::test {

/// Integrals over the sphere S^3 by a plain sum over a grid on it.
struct SphereIntegral {
  /// Mean of exp(q^T A q) over the sphere.
  double F = 0.0;
  /// Of q q^T under the density that goes as exp(q^T A q).
  Eigen::Matrix4d scatter = Eigen::Matrix4d::Zero();
};

/// For eigenvalues of A down to about -40: the grid has 64 x 64 x 300 points.
SphereIntegral literal_sphere_integral(Eigen::Matrix4d const& A);

/// Integral of exp(q^T diag(z, 0) q) over S^3, approximately: the saddlepoint of Kume and Wood
/// (2005), without and with the second-order correction.
struct Saddlepoint {
  double plain = 0.0;
  double corrected = 0.0;
};
Saddlepoint saddlepoint_constant(Eigen::Vector3d const& z);

/// 1F1(a; b; z) for z <= 0, by its series after Kummer's transformation.
double literal_1F1(double a, double b, double z);

/// Means over the circle of exp(x (cos t - 1)), that is exp(-x) I0(x), and of the same times cos t,
/// exp(-x) I1(x), and times 1 - cos t.
struct LiteralBessel {
  double zero = 0.0;
  double one = 0.0;
  double one_less = 0.0;
};
LiteralBessel literal_bessel(double x);

}  // namespace credo::test
