#include "eval/true_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "geometry/shapes/surface_points.hpp"

namespace credo {
namespace {

double angle_between(Eigen::Vector3d const& a, Eigen::Vector3d const& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

TrueModel::TrueModel(ObjectModel const& model) : symmetry_(model.symmetry), shape_(model) {
  double const size_m = shape_.bounds().diagonal().norm();
  surface_points_ = surface_points(model, size_m / 40.0);
  for (std::size_t i = 0; i < surface_points_.size(); ++i) {
    for (std::size_t j = i + 1; j < surface_points_.size(); ++j) {
      diameter_m_ = std::max(diameter_m_, (surface_points_[i] - surface_points_[j]).norm());
    }
  }
}

double TrueModel::centre_distance_m(Se3 const& a, Se3 const& b) const {
  Eigen::Vector3d const centre = shape_.bounds().center();
  return (a * centre - b * centre).norm();
}

TrueModel::PoseError TrueModel::error(Se3 const& believed, Se3 const& truth) const {
  if (symmetry_.axis) {
    Eigen::Vector3d const& point = symmetry_.axis->point_m;
    Eigen::Vector3d const& axis = symmetry_.axis->direction;
    double const tilt = angle_between(believed.rotation() * axis, truth.rotation() * axis);
    return {(believed * point - truth * point).norm(),
            symmetry_.axis->both_ways ? std::min(tilt, std::numbers::pi - tilt) : tilt};
  }
  double angle = believed.rotation().angularDistance(truth.rotation());
  for (Eigen::Quaterniond const& turn : symmetry_.rotations) {
    angle = std::min(angle, believed.rotation().angularDistance(truth.rotation() * turn));
  }
  return {(believed.translation() - truth.translation()).norm(), angle};
}

double TrueModel::add_s_m(Se3 const& believed, Se3 const& truth) const {
  Se3 const T_true_believed = truth.inverse() * believed;
  double sum = 0.0;
  for (Eigen::Vector3d const& point : surface_points_) {
    sum += std::abs(shape_.distance_to(T_true_believed * point).distance_m);
  }
  return sum / static_cast<double>(surface_points_.size());
}

double TrueModel::add_m(Se3 const& believed, Se3 const& truth) const {
  double sum = 0.0;
  for (Eigen::Vector3d const& point : surface_points_) {
    sum += (believed * point - truth * point).norm();
  }
  return sum / static_cast<double>(surface_points_.size());
}

}  // namespace credo
