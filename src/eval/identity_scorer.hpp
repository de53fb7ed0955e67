#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/label.hpp"
#include "core/scores.hpp"
#include "eval/label_overlap.hpp"

namespace credo {

/// Whether a thing that nobody told of keeps its id. Counts as in multi-object tracking (Bernardin
/// and Stiefelhagen 2008): a thing is followed in a frame by the piece whose segment has an IoU
/// above a half with it.
class IdentityScorer {
public:
  /// `bodies`: true labels of what is to be followed in this frame; others are out of sight, which
  /// is no interruption.
  void add(BeliefSummary const& belief, LabelOverlap const& overlap,
           std::vector<LabelCode> const& bodies);
  /// A thing that was taken away: if it ever comes back, that is a new story.
  void forget(LabelCode body) { tracks_.erase(body); }

  [[nodiscard]] StuffScores scores() const { return scores_; }

private:
  struct Track {
    std::uint32_t id = 0;
    bool interrupted = false;
  };
  std::map<LabelCode, Track> tracks_;
  StuffScores scores_;
};

}  // namespace credo
