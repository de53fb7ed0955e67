#include "eval/told_objects.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

namespace credo {
namespace {

using Match = std::vector<std::optional<std::size_t>>;

Match nearest_pairs(BeliefSummary const& belief, FrameTruth const& truth,
                    std::function<bool(TrueThing const&)> const& may_be) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // distance, believed, true
  for (std::size_t b = 0; b < belief.objects.size(); ++b) {
    for (std::size_t t = 0; t < truth.objects.size(); ++t) {
      ObjectSummary const& object = belief.objects[b];
      TrueThing const& thing = truth.objects[t];
      if (object.type == thing.type && may_be(thing)) {
        pairs.emplace_back((object.position_m - thing.pose.translation()).norm(), b, t);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  Match match(belief.objects.size());
  std::vector<bool> taken(truth.objects.size(), false);
  for (auto const& [distance_m, b, t] : pairs) {
    if (!match[b] && !taken[t]) {
      match[b] = t;
      taken[t] = true;
    }
  }
  return match;
}

}  // namespace

ToldObjects::ToldObjects(BeliefSummary const& belief, FrameTruth const& truth) {
  for (auto const& thing : nearest_pairs(belief, truth, [](TrueThing const&) { return true; })) {
    if (thing) {
      told_.insert(truth.objects[*thing].id);
    }
  }
}

Match ToldObjects::match(BeliefSummary const& belief, FrameTruth const& truth) const {
  return nearest_pairs(belief, truth, [this](TrueThing const& thing) { return told(thing.id); });
}

}  // namespace credo
