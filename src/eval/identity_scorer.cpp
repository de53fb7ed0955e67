#include "eval/identity_scorer.hpp"

namespace credo {
namespace {

std::optional<std::uint32_t> follower(BeliefSummary const& belief, LabelOverlap const& overlap,
                                      LabelCode body) {
  auto const segment = overlap.best_segment(body);
  if (!segment || !(segment->iou > 0.5)) {
    return std::nullopt;
  }
  for (StuffSummary const& piece : belief.stuff) {
    if (piece.label == segment->label) {
      return piece.id;
    }
  }
  return std::nullopt;
}

}  // namespace

void IdentityScorer::add(BeliefSummary const& belief, LabelOverlap const& overlap,
                         std::vector<LabelCode> const& bodies) {
  for (LabelCode const body : bodies) {
    auto const id = follower(belief, overlap, body);
    auto const track = tracks_.find(body);
    if (!id) {
      if (track != tracks_.end()) {
        track->second.interrupted = true;
      }
      continue;
    }
    ++scores_.item_frames;
    if (track != tracks_.end()) {
      if (track->second.id != *id) {
        scores_.switches.push_back({belief.frame, body, track->second.id, *id});
      }
      scores_.fragmentations += track->second.interrupted ? 1 : 0;
    }
    tracks_[body] = {*id, false};
  }
}

}  // namespace credo
