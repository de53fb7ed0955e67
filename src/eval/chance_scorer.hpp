#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/scores.hpp"
#include "core/truth.hpp"
#include "eval/label_overlap.hpp"
#include "eval/true_model.hpp"

namespace credo {

/// Known objects that a detector could have found, by which fusion.objects.never_found_px and the
/// like are fitted: those that are there and where they are believed to be, in frames that show
/// any pixel of them.
class ChanceScorer {
public:
  /// One belief; `match` as ToldObjects gives it, `overlap` of the frame's labels.
  void add(BeliefSummary const& belief, FrameTruth const& truth,
           std::vector<std::optional<std::size_t>> const& match, TrueModels const& models,
           LabelOverlap const& overlap);
  [[nodiscard]] std::vector<Chance> const& chances() const { return chances_; }

private:
  std::vector<Chance> chances_;
};

}  // namespace credo
