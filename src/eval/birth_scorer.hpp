#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/label.hpp"
#include "core/scores.hpp"
#include "core/truth.hpp"
#include "eval/stuff_bodies.hpp"
#include "eval/told_objects.hpp"

namespace credo {

/// Pieces of stuff in the frame in which they come up, by which fusion.births is fitted.
class BirthScorer {
public:
  /// `bodies` as they are with the frame.
  void add(BeliefSummary const& belief, LabelMap const& labels, StuffBodies const& bodies,
           FrameTruth const& truth, ToldObjects const& told);
  [[nodiscard]] std::vector<Birth> const& births() const { return births_; }

private:
  std::set<std::uint32_t> known_;
  std::vector<Birth> births_;
};

}  // namespace credo
