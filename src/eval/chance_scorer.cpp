#include "eval/chance_scorer.hpp"

#include "eval/object_scorer.hpp"

namespace credo {

void ChanceScorer::add(BeliefSummary const& belief, FrameTruth const& truth,
                       std::vector<std::optional<std::size_t>> const& match,
                       TrueModels const& models, LabelOverlap const& overlap) {
  for (std::size_t i = 0; i < belief.objects.size(); ++i) {
    ObjectSummary const& object = belief.objects[i];
    if (!match[i] || !object.why || !is_where_believed(object, truth.objects[*match[i]], models)) {
      continue;
    }
    auto const shown = overlap.true_sizes().find(truth.objects[*match[i]].label);
    if (shown != overlap.true_sizes().end()) {
      chances_.push_back({belief.frame, object.id, object.why->visible_share, shown->second,
                          object.evidence == Evidence::kSeen});
    }
  }
}

}  // namespace credo
