#include "eval/camera_scorer.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace credo {
namespace {

/// What is left, root mean square, when the one way is laid on the other as well as a rigid motion
/// can (Horn 1987; Sturm et al. 2012).
double rms_after_alignment_m(std::vector<Eigen::Vector3d> const& positions,
                             std::vector<Eigen::Vector3d> const& truth) {
  Eigen::Matrix3Xd from(3, positions.size());
  Eigen::Matrix3Xd to(3, positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = positions[i];
    to.col(static_cast<Eigen::Index>(i)) = truth[i];
  }
  Eigen::Isometry3d const T_true_told(Eigen::umeyama(from, to, false));
  return std::sqrt((T_true_told * from - to).colwise().squaredNorm().mean());
}

}  // namespace

void CameraScorer::add(Se3 const& T_world_camera, Se3 const& truth) {
  translation_m_.add((T_world_camera.translation() - truth.translation()).norm());
  rotation_deg_.add(T_world_camera.rotation().angularDistance(truth.rotation()) * 180.0 /
                    std::numbers::pi);
  positions_.push_back(T_world_camera.translation());
  true_positions_.push_back(truth.translation());
}

std::optional<CameraScores> CameraScorer::scores() const {
  if (positions_.empty()) {
    return std::nullopt;
  }
  return CameraScores{*translation_m_.value(), *rotation_deg_.value(),
                      rms_after_alignment_m(positions_, true_positions_)};
}

}  // namespace credo
