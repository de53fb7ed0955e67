#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/scores.hpp"
#include "core/se3.hpp"
#include "eval/mean.hpp"

namespace credo {

/// How far a camera's way is from the true one.
class CameraScorer {
public:
  void add(Se3 const& T_world_camera, Se3 const& truth);
  /// None without a frame.
  [[nodiscard]] std::optional<CameraScores> scores() const;

private:
  Mean translation_m_;
  Mean rotation_deg_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Eigen::Vector3d> true_positions_;
};

}  // namespace credo
