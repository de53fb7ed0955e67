#include "eval/stuff_bodies.hpp"

#include <algorithm>
#include <vector>

namespace credo {
namespace {

TrueThing const* find_in(std::vector<TrueThing> const& things, LabelCode label) {
  auto const found = std::find_if(things.begin(), things.end(),
                                  [&](TrueThing const& thing) { return thing.label == label; });
  return found == things.end() ? nullptr : &*found;
}

}  // namespace

TrueThing const* thing_with(LabelCode label, FrameTruth const& truth) {
  TrueThing const* const object = find_in(truth.objects, label);
  return object != nullptr ? object : find_in(truth.stuff, label);
}

TrueThing const* thing_called(std::string const& id, FrameTruth const& truth) {
  for (auto const* things : {&truth.objects, &truth.stuff}) {
    auto const found = std::find_if(things->begin(), things->end(),
                                    [&](TrueThing const& thing) { return thing.id == id; });
    if (found != things->end()) {
      return &*found;
    }
  }
  return nullptr;
}

void StuffBodies::update(BeliefSummary const& belief, FrameTruth const& truth,
                         LabelOverlap const& overlap) {
  std::map<LabelCode, LabelCode> const body_of = overlap.bodies();
  for (StuffSummary const& piece : belief.stuff) {
    if (!piece.label) {
      continue;
    }
    Body body;
    body.last_seen = truth.frame;
    body.centroid_m = piece.centroid_m.cast<double>();
    if (auto const found = body_of.find(*piece.label); found != body_of.end()) {
      body.label = found->second;
      if (TrueThing const* const thing = thing_with(found->second, truth)) {
        body.pose = thing->pose;
      }
    }
    bodies_[piece.id] = body;
  }
}

StuffBodies::Body const* StuffBodies::body(std::uint32_t stuff_id) const {
  auto const found = bodies_.find(stuff_id);
  return found == bodies_.end() ? nullptr : &found->second;
}

bool StuffBodies::is_there(std::uint32_t stuff_id, FrameTruth const& truth,
                           ToldObjects const& told) const {
  Body const* const known = body(stuff_id);
  TrueThing const* const thing =
      known != nullptr && known->label ? thing_with(*known->label, truth) : nullptr;
  return thing != nullptr && !told.told(thing->id) && thing->present && known->pose &&
         (thing->pose.translation() - known->pose->translation()).norm() <= kSamePlace_m;
}

}  // namespace credo
