#include "stages/fusion/existence.hpp"

#include <algorithm>
#include <cmath>

namespace credo {

ViewChange view_change(Look const& before, Look const& now) {
  constexpr double kSecondsPerNanosecond = 1e-9;
  return {.elapsed_s = std::max(
              0.0, static_cast<double>(now.stamp_ns - before.stamp_ns) * kSecondsPerNanosecond),
          .camera_before_world = before.camera_world,
          .camera_now_world = now.camera_world};
}

ViewChange view_change(BeliefState const& belief, Segmentation const& segmentation) {
  Look const now{segmentation.stamp_ns, segmentation.T_world_camera.translation()};
  if (belief.frame == kPriorFrame) {
    return {0.0, std::nullopt, now.camera_world};
  }
  return view_change({belief.stamp_ns, belief.T_world_camera.translation()}, now);
}

double novelty(ViewChange const& change, Eigen::Vector3d const& point_world,
               ExistenceConfig const& config) {
  if (!change.camera_before_world || config.correlation_time_s == 0.0) {
    return 1.0;
  }
  Eigen::Vector3d const before = point_world - *change.camera_before_world;
  Eigen::Vector3d const now = point_world - change.camera_now_world;
  double const turned_rad = std::atan2(before.cross(now).norm(), before.dot(now));
  return 1.0 - std::exp(-(change.elapsed_s / config.correlation_time_s +
                          turned_rad / config.correlation_angle_rad));
}

double updated_log_odds(double log_odds, Evidence before, Evidence now, double novelty,
                        ExistenceConfig const& config) {
  bool const seen = now == Evidence::kSeen;
  double const if_present = seen ? config.seen_if_present : 1.0 - config.seen_if_present;
  double const if_absent = seen ? config.seen_if_absent : 1.0 - config.seen_if_absent;
  bool const changed = seen != (before == Evidence::kSeen);
  double const k = changed ? 1.0 : novelty;
  double const updated =
      log_odds + std::log((1.0 - k + k * if_present) / (1.0 - k + k * if_absent));
  return bounded_log_odds(updated, config);
}

double log_odds_step(double ratio, double counts) {
  double const if_there = ratio / (1.0 + ratio);
  double const if_not = 1.0 / (1.0 + ratio);
  return std::log((1.0 - counts + counts * if_there) / (1.0 - counts + counts * if_not));
}

void add_step(double& log_odds, double step, Account& why, ExistenceConfig const& config) {
  double const before = log_odds;
  log_odds = bounded_log_odds(before + step, config);
  why.moved += log_odds - before;
  why.bounded = log_odds != before + step;
}

double birth_log_odds(double thickness_blocks, bool arrived, BirthConfig const& config,
                      ExistenceConfig const& existence) {
  double told =
      config.log_odds + config.per_log_thickness * std::log(std::max(thickness_blocks, 1e-3));
  if (arrived) {
    told = std::min(told, log_odds_of(config.arrived_probability));
  }
  // What is worth a place in the belief is not forgotten before it is looked at again.
  double const least = log_odds_of(2.0 * existence.min_probability);
  return bounded_log_odds(std::max(least, told), existence);
}

double bounded_log_odds(double log_odds, ExistenceConfig const& config) {
  return config.max_log_odds == 0.0
             ? log_odds
             : std::clamp(log_odds, -config.max_log_odds, config.max_log_odds);
}

}  // namespace credo
