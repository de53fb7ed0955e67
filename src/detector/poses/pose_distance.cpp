#include "detector/poses/pose_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace credo {
namespace {

float angle_of(float cosine) {
  return std::acos(std::clamp(cosine, -1.0F, 1.0F));
}

}  // namespace

PoseDistance::PoseDistance(SearchModel const& model)
    : centre_model_(model.centre_model), per_rad_m_(0.35F * model.diameter_m) {
  rotations_.push_back(Eigen::Matrix3f::Identity());
  if (model.symmetry.axis) {
    has_axis_ = true;
    axis_model_ = model.symmetry.axis->direction.cast<float>();
    Eigen::Vector3f const point = model.symmetry.axis->point_m.cast<float>();
    on_axis_model_ = point + axis_model_ * axis_model_.dot(centre_model_ - point);
    both_ways_ = model.symmetry.axis->both_ways;
    on_axis_turned_model_ = 2.0F * point - on_axis_model_;
  }
  for (Eigen::Quaterniond const& rotation : model.symmetry.rotations) {
    rotations_.emplace_back(rotation.toRotationMatrix().cast<float>());
  }
}

float PoseDistance::operator()(CameraPose const& a, CameraPose const& b) const {
  if (has_axis_) {
    float const cosine = (a.rotation * axis_model_).dot(b.rotation * axis_model_);
    Eigen::Vector3f const of_a = a * on_axis_model_;
    float const as_it_is_m = (of_a - b * on_axis_model_).norm() + per_rad_m_ * angle_of(cosine);
    if (!both_ways_) {
      return as_it_is_m;
    }
    float const turned_m =
        (of_a - b * on_axis_turned_model_).norm() + per_rad_m_ * angle_of(-cosine);
    return std::min(as_it_is_m, turned_m);
  }
  float least_m = std::numeric_limits<float>::infinity();
  for (Eigen::Matrix3f const& turn : rotations_) {
    Eigen::Matrix3f const turned = b.rotation * turn;
    float const trace = (a.rotation.array() * turned.array()).sum();
    float const shift_m = (a * centre_model_ - (turned * centre_model_ + b.translation_m)).norm();
    least_m = std::min(least_m, shift_m + per_rad_m_ * angle_of((trace - 1.0F) / 2.0F));
  }
  return least_m;
}

}  // namespace credo
