#include "eval/evaluation.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace credo {
namespace {

/// What the robot was not told of, as far as this frame shows enough of it to be followed.
std::vector<LabelCode> bodies_to_follow(FrameTruth const& truth, ToldObjects const& told,
                                        LabelOverlap const& overlap, std::size_t pixels) {
  std::vector<LabelCode> bodies;
  for (auto const* things : {&truth.objects, &truth.stuff}) {
    for (TrueThing const& thing : *things) {
      auto const size = overlap.true_sizes().find(thing.label);
      if (!told.told(thing.id) && size != overlap.true_sizes().end() &&
          static_cast<double>(size->second) >=
              ChangeScorer::kShownShare * static_cast<double>(pixels)) {
        bodies.push_back(thing.label);
      }
    }
  }
  return bodies;
}

}  // namespace

void Evaluation::add_segments(EvalFrame const& frame, LabelOverlap const& overlap) {
  std::vector<LabelCode> instances;
  std::map<LabelCode, PixelClass> classes = {{kFloor, PixelClass::kGround}};
  for (TrueWall const& wall : frame.truth.walls) {
    classes[wall.label] = PixelClass::kWall;
  }
  for (TrueThing const& object : frame.truth.objects) {
    classes[object.label] = told_->told(object.id) ? PixelClass::kObject : PixelClass::kStuff;
    instances.push_back(object.label);
  }
  for (TrueThing const& thing : frame.truth.stuff) {
    classes[thing.label] = PixelClass::kStuff;
    instances.push_back(thing.label);
  }
  instances_.add(overlap, instances);
  OverlapScorer only_this;
  only_this.add(overlap, instances);
  if (auto const scores = only_this.scores()) {
    trace_.back().weighted_overlap = scores->weighted_overlap;
  }
  classes_.add(overlap, classes);
}

void Evaluation::add_existence(EvalFrame const& frame,
                               std::vector<std::optional<std::size_t>> const& match) {
  BeliefSummary const& belief = *frame.belief;
  for (std::size_t i = 0; i < belief.objects.size(); ++i) {
    ObjectSummary const& object = belief.objects[i];
    bool const is_there =
        match[i] && is_where_believed(object, frame.truth.objects[*match[i]], models_);
    existence_.add(object.probability, is_there);
    trace_.back().objects.push_back({object.id, object.probability, is_there});
  }
  for (StuffSummary const& piece : belief.stuff) {
    if (bodies_.body(piece.id) != nullptr) {
      existence_.add(piece.probability, bodies_.is_there(piece.id, frame.truth, *told_));
    }
  }
}

void Evaluation::add_camera(EvalFrame const& frame) {
  camera_.add(Se3::from_matrix(frame.belief->T_world_camera), frame.truth.T_world_camera);
  if (frame.T_world_told) {
    camera_told_.add(*frame.T_world_told, frame.truth.T_world_camera);
  }
}

void Evaluation::add_floor(EvalFrame const& frame) {
  auto const& believed = frame.belief->floor;
  auto const& floor = frame.truth.floor;
  if (believed && floor) {
    double const sine = believed->normal.cross(floor->normal).norm();
    double const cosine = believed->normal.dot(floor->normal);
    double const tilt_deg = std::atan2(sine, cosine) * 180.0 / std::numbers::pi;
    floor_tilt_deg_.add(tilt_deg);
    trace_.back().floor_tilt_deg = tilt_deg;
    floor_height_m_.add(std::abs(believed->height_m - floor->height_m));
  }
}

void Evaluation::add_poses(EvalFrame const& frame,
                           std::vector<std::optional<std::size_t>> const& match) {
  objects_.add(*frame.belief, frame.truth, *told_, match, models_);
  ObjectScorer only_this;
  only_this.add(*frame.belief, frame.truth, *told_, match, models_);
  trace_.back().translation_m = only_this.scores().translation_m;
  trace_.back().rotation_deg = only_this.scores().rotation_deg;
}

void Evaluation::forget_what_was_removed(FrameTruth const& truth) {
  for (TrueEvent const& event : truth.events) {
    TrueThing const* const thing = thing_called(event.id, truth);
    if (thing != nullptr && event.what == "removed") {
      identity_.forget(thing->label);
    }
  }
}

void Evaluation::add_images(EvalFrame const& frame,
                            std::vector<std::optional<std::size_t>> const& match) {
  has_labels_ = true;
  LabelOverlap const overlap(*frame.labels, *frame.true_labels);
  bodies_.update(*frame.belief, frame.truth, overlap);
  births_.add(*frame.belief, *frame.labels, bodies_, frame.truth, *told_);
  chances_.add(*frame.belief, frame.truth, match, models_, overlap);
  add_segments(frame, overlap);
  identity_.add(*frame.belief, overlap,
                bodies_to_follow(frame.truth, *told_, overlap, frame.labels->size()));
  if (intrinsics_) {
    change_.add({*frame.belief, frame.truth, *told_, match, models_, bodies_, overlap, *intrinsics_,
                 frame.labels->width(), frame.labels->height()});
  }
}

void Evaluation::add(EvalFrame const& frame) {
  if (!told_ && frame.belief != nullptr) {
    told_.emplace(*frame.belief, frame.truth);
  }
  if (frame.true_labels != nullptr && intrinsics_) {
    walls_.see(frame.truth, *frame.true_labels, *intrinsics_);
  }
  if (!told_) {
    return;
  }
  change_.happen(frame.truth, *told_);
  forget_what_was_removed(frame.truth);
  if (frame.belief == nullptr) {
    return;
  }
  trace_.push_back({});
  trace_.back().frame = frame.belief->frame;
  auto const match = told_->match(*frame.belief, frame.truth);
  add_camera(frame);
  add_floor(frame);
  walls_.add(*frame.belief, frame.truth);
  add_poses(frame, match);
  if (frame.labels != nullptr && frame.true_labels != nullptr) {
    add_images(frame, match);
  }
  add_existence(frame, match);
}

Scores Evaluation::scores() const {
  Scores scores;
  scores.frames = trace_.size();
  scores.camera = camera_.scores();
  scores.camera_told = camera_told_.scores();
  scores.segmentation.instances = instances_.scores();
  scores.segmentation.iou = classes_.iou();
  if (auto const tilt_deg = floor_tilt_deg_.value()) {
    scores.floor = FloorScores{*tilt_deg, *floor_height_m_.value()};
  }
  if (intrinsics_) {
    scores.walls = walls_.scores();
  }
  scores.objects = objects_.scores();
  scores.existence = existence_.scores();
  scores.change = change_.scores();
  if (has_labels_) {
    scores.stuff = identity_.scores();
    scores.births = births_.births();
    scores.chances = chances_.chances();
  }
  return scores;
}

void LabelEvaluation::add(LabelMap const& labels, LabelMap const& true_labels) {
  constexpr LabelCode kFirstThing = 20;
  LabelOverlap const parts(labels, true_labels);
  // The table's own labels stay apart from the first ten of things.
  LabelOverlap const things = parts.with_merged_truth([](LabelCode label) {
    return label < kFirstThing ? label : static_cast<LabelCode>(label / 10 * 10);
  });
  auto const instances = [](LabelOverlap const& overlap) {
    std::vector<LabelCode> of;
    for (auto const& [label, pixels] : overlap.true_sizes()) {
      if (label >= kFirstThing) {
        of.push_back(label);
      }
    }
    return of;
  };
  parts_.add(parts, instances(parts));
  things_.add(things, instances(things));
  ++frames_;
}

Scores LabelEvaluation::scores() const {
  Scores scores;
  scores.frames = frames_;
  scores.segmentation.instances = parts_.scores();
  scores.segmentation.merged = things_.scores();
  return scores;
}

}  // namespace credo
