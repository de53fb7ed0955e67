#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/belief_summary.hpp"
#include "history/history.hpp"

namespace credo::test {

inline constexpr std::int64_t kFrame_ns = 100'000'000;

/// A belief of nothing, ten of which make a second; the first one at a minute.
inline BeliefSummary empty_belief(std::int64_t frame) {
  BeliefSummary belief;
  belief.frame = FrameIndex{frame};
  belief.stamp_ns = 60 * 10 * kFrame_ns + frame * kFrame_ns;
  return belief;
}

inline StuffSummary stuff_at(std::uint32_t id, double log_odds, Evidence evidence, double moved) {
  StuffSummary stuff;
  stuff.id = id;
  stuff.probability = probability_of(log_odds);
  stuff.log_odds = log_odds;
  stuff.evidence = evidence;
  stuff.why = Account();
  stuff.why->moved = moved;
  return stuff;
}

/// Thing 7 in frames 2 to 8 of ten, frame 5 lost: seen twice, hidden twice, seen through twice,
/// then forgotten. Its log-odds: 1, 3, 3, 3, 1, -1.
inline std::vector<BeliefSummary> run_of_ten() {
  std::vector<BeliefSummary> run;
  for (std::int64_t const frame : {0, 1, 2, 3, 4, 6, 7, 8, 9}) {
    run.push_back(empty_belief(frame));
  }
  auto const add = [&](std::size_t position, double log_odds, Evidence evidence, double moved) {
    return &run[position].stuff.emplace_back(stuff_at(7, log_odds, evidence, moved));
  };
  add(2, 1.0, Evidence::kSeen, 0.0)->why->points[PointState::kAgrees] = 10;
  add(3, 3.0, Evidence::kSeen, 2.0)->why->points[PointState::kAgrees] = 20;
  run[3].stuff[0].why->points[PointState::kOccluded] = 20;
  run[3].stuff[0].why->news = 0.5;
  run[3].stuff[0].why->bounded = true;
  add(4, 3.0, Evidence::kOccluded, 0.0);
  add(5, 3.0, Evidence::kOccluded, 0.0);
  add(6, 1.0, Evidence::kSeenThrough, -2.0)->why->news = 1.0;
  add(7, -1.0, Evidence::kSeenThrough, -2.0)->why->news = 0.5;
  return run;
}

}  // namespace credo::test
