#include "truth_detector.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>

namespace credo {

std::vector<Detection> TruthDetector::detect(Frame const& frame,
                                             std::vector<DetectionRequest> const& requests) {
  Vector6d sigmas;
  sigmas << Eigen::Vector3d::Constant(0.004), Eigen::Vector3d::Constant(0.035);
  auto const number = static_cast<std::size_t>(credo::number(frame.index));
  std::mt19937_64 random(number);
  std::normal_distribution<double> normal;
  std::vector<Detection> found;
  for (TrueInstance const& truth : views_.at(number).truths) {
    bool const asked = std::ranges::any_of(
        requests, [&](DetectionRequest const& request) { return request.type == truth.model; });
    if (!asked || truth.visible_fraction < kLeastVisible) {
      continue;
    }
    Vector6d error;
    for (Eigen::Index i = 0; i < error.size(); ++i) {
      error[i] = sigmas[i] * normal(random);
    }
    found.push_back({truth.model,
                     {boxplus(truth.pose_camera, error), sigmas.cwiseAbs2().asDiagonal()},
                     truth.visible_fraction,
                     truth.visible_fraction});
  }
  return found;
}

}  // namespace credo
