#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/scores.hpp"
#include "core/truth.hpp"
#include "eval/mean.hpp"
#include "eval/nees_bounds.hpp"
#include "eval/told_objects.hpp"
#include "eval/true_model.hpp"

namespace credo {

/// Believed: a probability of a half or more.
inline constexpr double kBelieved = 0.5;

/// Whether a true object is present and is where it is believed to be: the middles of both are
/// within half the model's diameter. Without a model of its type: the origins within 0.1 m.
[[nodiscard]] bool is_where_believed(ObjectSummary const& believed, TrueThing const& thing,
                                     TrueModels const& models);

/// Poses and presence of the known objects, over frames.
class ObjectScorer {
public:
  /// One belief; `match` as ToldObjects gives it.
  void add(BeliefSummary const& belief, FrameTruth const& truth, ToldObjects const& told,
           std::vector<std::optional<std::size_t>> const& match, TrueModels const& models);
  [[nodiscard]] ObjectScores scores() const;

private:
  void add_pose(FrameIndex frame, ObjectSummary const& believed, TrueThing const& thing,
                TrueModel const* model);

  std::set<std::string> seen_;
  Mean translation_m_;
  Mean rotation_deg_;
  Mean nees_;
  Mean degrees_of_freedom_;
  RepeatedClaims repeated_;
  std::vector<PoseClaim> claims_;
  Mean precise_;
  Mean recalled_;
  Mean within_tenth_;
};

}  // namespace credo
