#include "eval/change_scorer.hpp"

#include <algorithm>

#include "eval/object_scorer.hpp"

namespace credo {
namespace {

bool is_in_view(Eigen::Vector3d const& p_world, ChangeFrame const& frame) {
  Eigen::Vector3d const p = frame.truth.T_world_camera.inverse() * p_world;
  if (!(p.z() > 0.0)) {
    return false;
  }
  double const u_px = frame.intrinsics.fx_px * p.x() / p.z() + frame.intrinsics.cx_px;
  double const v_px = frame.intrinsics.fy_px * p.y() / p.z() + frame.intrinsics.cy_px;
  return u_px >= 0.0 && v_px >= 0.0 && u_px < frame.width_px && v_px < frame.height_px;
}

std::map<std::uint32_t, double> probabilities(BeliefSummary const& belief) {
  std::map<std::uint32_t, double> of;
  for (StuffSummary const& piece : belief.stuff) {
    of[piece.id] = piece.probability;
  }
  return of;
}

bool is_believed(std::map<std::uint32_t, double> const& probabilities, std::uint32_t id) {
  auto const found = probabilities.find(id);
  return found != probabilities.end() && found->second >= kBelieved;
}

/// Whether what is believed of a piece goes on as a part of another that it became one with.
bool goes_on_in_another(std::uint32_t id, BeliefSummary const& belief) {
  return std::ranges::any_of(belief.stuff, [&](StuffSummary const& piece) {
    return piece.probability >= kBelieved && std::ranges::count(piece.joined_ids, id) > 0;
  });
}

/// The known object that means a true one; null where none does.
ObjectSummary const* believed_as(std::string const& true_id, ChangeFrame const& frame) {
  for (std::size_t i = 0; i < frame.match.size(); ++i) {
    if (frame.match[i] && frame.truth.objects[*frame.match[i]].id == true_id) {
      return &frame.belief.objects[i];
    }
  }
  return nullptr;
}

/// Whether a known object is believed to be nearer to where it is than to where it was.
bool is_at_new_place(ObjectSummary const& believed, Se3 const& new_pose, Se3 const& old_pose) {
  Eigen::Vector3d const& p = believed.position_m;
  if ((new_pose.translation() - old_pose.translation()).norm() >= 0.01) {
    return (p - new_pose.translation()).norm() < (p - old_pose.translation()).norm();
  }
  return believed.orientation.angularDistance(new_pose.rotation()) <
         believed.orientation.angularDistance(old_pose.rotation());
}

}  // namespace

void ChangeScorer::happen(FrameTruth const& truth, ToldObjects const& told) {
  for (TrueEvent const& event : truth.events) {
    TrueThing const* const thing = thing_called(event.id, truth);
    if (thing == nullptr) {
      continue;
    }
    if (auto const before = open_.find(thing->label); before != open_.end()) {
      close(before->second, std::nullopt);
      open_.erase(before);
    }
    Change change;
    change.what = event.what;
    change.label = thing->label;
    change.id = event.id;
    change.told = told.told(event.id);
    change.since = truth.frame;
    if (auto const pose = true_poses_.find(event.id); pose != true_poses_.end()) {
      change.old_pose = pose->second;
    }
    for (auto const& [id, body] : believed_pieces_) {
      if (body.label == thing->label) {
        change.old_pieces[id] = body.centroid_m;
      }
    }
    change.was_believed = change.told ? believed_by_true_id_[event.id] : !change.old_pieces.empty();
    open_[thing->label] = change;
  }
  for (auto const* things : {&truth.objects, &truth.stuff}) {
    for (TrueThing const& thing : *things) {
      true_poses_[thing.id] = thing.pose;
    }
  }
}

void ChangeScorer::look(Change& change, ChangeFrame const& frame) {
  auto const size = frame.overlap.true_sizes().find(change.label);
  if (size != frame.overlap.true_sizes().end()) {
    double const pixels = static_cast<double>(frame.width_px) * frame.height_px;
    change.shown = change.shown || static_cast<double>(size->second) >= kShownShare * pixels;
  }
  for (auto const& [id, centroid_m] : change.old_pieces) {
    change.old_place_in_view = change.old_place_in_view || is_in_view(centroid_m, frame);
  }
  if (change.old_pose) {
    change.old_place_in_view =
        change.old_place_in_view || is_in_view(change.old_pose->translation(), frame);
  }
}

bool ChangeScorer::is_noticed(Change const& change, ChangeFrame const& frame) const {
  TrueThing const* const thing = thing_called(change.id, frame.truth);
  if (thing == nullptr) {
    return false;
  }
  if (change.told) {
    ObjectSummary const* const object = believed_as(change.id, frame);
    bool const believed = object != nullptr && object->probability >= kBelieved;
    if (change.what == "removed") {
      return !believed;
    }
    return believed && is_where_believed(*object, *thing, frame.models) &&
           (change.what != "moved" || !change.old_pose ||
            is_at_new_place(*object, thing->pose, *change.old_pose));
  }
  auto const probability = probabilities(frame.belief);
  for (auto const& [id, centroid_m] : change.old_pieces) {
    StuffBodies::Body const* const body = frame.bodies.body(id);
    bool const seen_since = body != nullptr && number(body->last_seen) >= number(change.since);
    if (is_believed(probability, id) && !seen_since) {
      return false;
    }
  }
  if (change.what == "removed") {
    return true;
  }
  return std::any_of(probability.begin(), probability.end(), [&](auto const& piece) {
    StuffBodies::Body const* const body = frame.bodies.body(piece.first);
    return piece.second >= kBelieved && body != nullptr && body->label == change.label &&
           number(body->last_seen) >= number(change.since);
  });
}

void ChangeScorer::close(Change const& change, std::optional<std::int64_t> delay_frames) {
  bool const could_be =
      change.what == "removed" ? change.was_believed && change.old_place_in_view : change.shown;
  if (!could_be) {
    return;
  }
  if (delay_frames) {
    delays_.push_back(*delay_frames);
  } else {
    ++missed_;
  }
}

void ChangeScorer::judge_pieces(ChangeFrame const& frame) {
  auto const probability = probabilities(frame.belief);
  auto const is_there = [&](std::uint32_t id) {
    return frame.bodies.is_there(id, frame.truth, frame.told);
  };
  for (auto const& [id, body] : believed_pieces_) {
    TrueThing const* const thing = body.label ? thing_with(*body.label, frame.truth) : nullptr;
    if (thing == nullptr || frame.told.told(thing->id) || is_believed(probability, id) ||
        goes_on_in_another(id, frame.belief)) {
      continue;
    }
    bool const has_another = std::ranges::any_of(probability, [&](auto const& other) {
      StuffBodies::Body const* const other_body = frame.bodies.body(other.first);
      return other.second >= kBelieved && other_body != nullptr &&
             other_body->label == thing->label && is_there(other.first);
    });
    bool const there = is_there(id);
    if (there && has_another) {
      continue;
    }
    ++claims_;
    right_claims_ += there ? 0 : 1;
  }
}

void ChangeScorer::judge_objects(ChangeFrame const& frame) {
  for (std::size_t i = 0; i < frame.belief.objects.size(); ++i) {
    ObjectSummary const& object = frame.belief.objects[i];
    auto const before = known_.find(object.id);
    bool const is = object.probability >= kBelieved;
    if (before == known_.end() || (before->second.probability >= kBelieved) == is) {
      continue;
    }
    TrueThing const* const thing = frame.match[i] ? &frame.truth.objects[*frame.match[i]] : nullptr;
    bool const there =
        thing != nullptr && is_where_believed(is ? object : before->second, *thing, frame.models);
    ++claims_;
    right_claims_ += there == is ? 1 : 0;
  }
}

void ChangeScorer::remember(ChangeFrame const& frame) {
  believed_pieces_.clear();
  for (StuffSummary const& piece : frame.belief.stuff) {
    StuffBodies::Body const* const body = frame.bodies.body(piece.id);
    if (piece.probability >= kBelieved && body != nullptr) {
      believed_pieces_[piece.id] = *body;
    }
  }
  for (std::size_t i = 0; i < frame.belief.objects.size(); ++i) {
    ObjectSummary const& object = frame.belief.objects[i];
    known_[object.id] = object;
    if (frame.match[i]) {
      TrueThing const& thing = frame.truth.objects[*frame.match[i]];
      believed_by_true_id_[thing.id] = object.probability >= kBelieved;
    }
  }
}

void ChangeScorer::add(ChangeFrame const& frame) {
  for (auto it = open_.begin(); it != open_.end();) {
    look(it->second, frame);
    if (is_noticed(it->second, frame)) {
      close(it->second, number(frame.truth.frame) - number(it->second.since));
      it = open_.erase(it);
    } else {
      ++it;
    }
  }
  judge_pieces(frame);
  judge_objects(frame);
  remember(frame);
}

ChangeScores ChangeScorer::scores() const {
  ChangeScorer finished = *this;
  for (auto const& [label, change] : open_) {
    finished.close(change, std::nullopt);
  }
  ChangeScores scores;
  scores.events = finished.delays_.size() + finished.missed_;
  if (claims_ > 0) {
    scores.precision = static_cast<double>(right_claims_) / static_cast<double>(claims_);
  }
  if (scores.events > 0) {
    scores.recall =
        static_cast<double>(finished.delays_.size()) / static_cast<double>(scores.events);
  }
  if (!finished.delays_.empty()) {
    auto& delays = finished.delays_;
    std::sort(delays.begin(), delays.end());
    std::size_t const half = delays.size() / 2;
    auto const upper = static_cast<double>(delays[half]);
    scores.delay_frames =
        delays.size() % 2 == 1 ? upper : 0.5 * (upper + static_cast<double>(delays[half - 1]));
  }
  return scores;
}

}  // namespace credo
