#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/belief.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// From where the last two frames were taken. Without a frame before, the new one is all news.
struct ViewChange {
  double elapsed_s = 0.0;
  std::optional<Eigen::Vector3d> camera_before_world;
  Eigen::Vector3d camera_now_world = Eigen::Vector3d::Zero();
};

/// From the last frame of the belief to the segmentation. Stamps that run backwards count as no
/// time.
[[nodiscard]] ViewChange view_change(BeliefState const& belief, Segmentation const& segmentation);

/// From one look at a thing to the next.
[[nodiscard]] ViewChange view_change(Look const& before, Look const& now);

/// How much of a frame is news about a thing at `point_world`, in [0, 1]: 1 - exp(-(dt / T + dtheta
/// / A)), with dt since the frame before, dtheta the angle by which the line of sight to the point
/// turned, T and A the correlation time and angle. A thesis observation was a look from another
/// place, full news; at 30 Hz a sensor that stands still sees the same pixels with the same faults,
/// and a quarter of a second of them counts like one look.
[[nodiscard]] double novelty(ViewChange const& change, Eigen::Vector3d const& point_world,
                             ExistenceConfig const& config);

/// Bayes' rule (thesis equation 4.1) in log-odds. Of the observation the part `novelty` is evidence
/// and the rest says nothing: L += log((1 - k + k P(Y|X)) / (1 - k + k P(Y|~X))), k = novelty. A
/// state that changed, seen after not seen or the reverse, is news in full: k = 1.
[[nodiscard]] double updated_log_odds(double log_odds, Evidence before, Evidence now,
                                      double novelty, ExistenceConfig const& config);

/// Bayes' rule in log-odds: what a look adds that is `ratio` times as likely if the thing is there,
/// and of which the part `counts` is evidence, as above. The same for P(look | there) = ratio / (1
/// + ratio) and P(look | not there) = 1 / (1 + ratio).
[[nodiscard]] double log_odds_step(double ratio, double counts);

/// Adds a step, within the bound, and gives account of it.
void add_step(double& log_odds, double step, Account& why, ExistenceConfig const& config);

/// Within the config's bound, if it has one.
[[nodiscard]] double bounded_log_odds(double log_odds, ExistenceConfig const& config);

}  // namespace credo
