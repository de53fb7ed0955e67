#include "sim/pose_error.hpp"

#include <cmath>
#include <cstdint>
#include <random>

namespace credo {

Se3 told_pose(SceneCamera const& camera, Se3 const& T_world_camera, double since_start_s, int seed,
              FrameIndex index) {
  bool const true_one = camera.pose_jitter_m == 0.0 && camera.pose_jitter_rad == 0.0 &&
                        camera.pose_drift_m_per_s == 0.0 && camera.pose_drift_rad_per_s == 0.0;
  if (true_one) {
    return T_world_camera;
  }
  auto const frame = static_cast<std::uint64_t>(number(index));
  // The last number tells these draws from those of a row of depth.
  std::seed_seq numbers{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(frame),
                        static_cast<std::uint32_t>(frame >> 32U), 0xFFFFFFFFU};
  std::mt19937_64 random(numbers);
  std::normal_distribution<double> normal;
  Vector6d error;
  for (int i = 0; i < 6; ++i) {
    error[i] = normal(random) * (i < 3 ? camera.pose_jitter_m : camera.pose_jitter_rad);
  }
  // Straight away, at 45 degrees to both axes.
  double const drift_m = camera.pose_drift_m_per_s * since_start_s / std::sqrt(2.0);
  error.head<2>() += Eigen::Vector2d(drift_m, drift_m);
  error[5] += camera.pose_drift_rad_per_s * since_start_s;
  return boxplus(T_world_camera, error);
}

}  // namespace credo
