#include "geometry/bingham/bingham.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "geometry/bingham/symmetric_eigen.hpp"

namespace credo {
namespace {

Eigen::Vector4d conjugate(Eigen::Vector4d const& q) {
  return {q[0], -q[1], -q[2], -q[3]};
}

}  // namespace

Eigen::Vector4d wxyz(Eigen::Quaterniond const& rotation) {
  return {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
}

Eigen::Quaterniond quaternion_of(Eigen::Vector4d const& wxyz) {
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

Eigen::Matrix4d left_product(Eigen::Vector4d const& a) {
  Eigen::Matrix4d matrix;
  matrix << a[0], -a[1], -a[2], -a[3],  //
      a[1], a[0], -a[3], a[2],          //
      a[2], a[3], a[0], -a[1],          //
      a[3], -a[2], a[1], a[0];
  return matrix;
}

Eigen::Matrix4d right_product(Eigen::Vector4d const& b) {
  Eigen::Matrix4d matrix;
  matrix << b[0], -b[1], -b[2], -b[3],  //
      b[1], b[0], b[3], -b[2],          //
      b[2], -b[3], b[0], b[1],          //
      b[3], b[2], -b[1], b[0];
  return matrix;
}

Eigen::Matrix4d Bingham::default_axes() {
  Eigen::Matrix4d axes = Eigen::Matrix4d::Zero();
  axes(1, 0) = axes(2, 1) = axes(3, 2) = axes(0, 3) = 1.0;
  return axes;
}

Bingham::Bingham(Eigen::Matrix4d const& axes, Eigen::Vector3d const& concentrations)
    : axes_(axes), concentrations_(concentrations) {
  constexpr double kTolerance = 1e-6;
  bool const orthonormal =
      (axes.transpose() * axes - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff() <= kTolerance;
  bool const ordered = std::isfinite(concentrations[0]) && concentrations[0] <= concentrations[1] &&
                       concentrations[1] <= concentrations[2] && concentrations[2] <= 0.0;
  if (!orthonormal || !ordered) {
    std::ostringstream text;
    text << "Bingham: axes must be orthonormal and concentrations z1 <= z2 <= z3 <= 0: axes\n"
         << axes << "\nconcentrations " << concentrations.transpose();
    throw std::logic_error(text.str());
  }
}

Bingham Bingham::of_parameters(Eigen::Matrix4d const& A) {
  if (!A.allFinite()) {
    throw std::logic_error("Bingham: the parameter matrix is not finite");
  }
  SymmetricEigen const parts = symmetric_eigen(0.5 * (A + A.transpose()));
  Bingham result;
  result.axes_ = parts.vectors;
  result.concentrations_ = parts.values.head<3>().array() - parts.values[3];
  return result;
}

Eigen::Matrix4d Bingham::parameters() const {
  auto const others = axes_.leftCols<3>();
  return others * concentrations_.asDiagonal() * others.transpose();
}

double Bingham::log_ratio_to_mode(Eigen::Quaterniond const& rotation) const {
  return (axes_.leftCols<3>().transpose() * wxyz(rotation)).cwiseAbs2().dot(concentrations_);
}

Bingham product(Bingham const& a, Bingham const& b) {
  return Bingham::of_parameters(a.parameters() + b.parameters());
}

Bingham rotated_left(Eigen::Quaterniond const& r, Bingham const& q) {
  return {left_product(wxyz(r)) * q.axes(), q.concentrations()};
}

Bingham rotated_right(Bingham const& q, Eigen::Quaterniond const& r) {
  return {right_product(wxyz(r)) * q.axes(), q.concentrations()};
}

Bingham inverse(Bingham const& q) {
  Eigen::Matrix4d axes;
  for (int i = 0; i < 4; ++i) {
    axes.col(i) = conjugate(q.axes().col(i));
  }
  return {axes, q.concentrations()};
}

}  // namespace credo
