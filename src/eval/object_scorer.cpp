#include "eval/object_scorer.hpp"

#include <Eigen/Cholesky>
#include <numbers>

#include "eval/nees_bounds.hpp"
#include "geometry/pose_fusion.hpp"

namespace credo {
namespace {

/// To be believed from the frame on that shows so much of it.
constexpr double kSeenFraction = 0.1;

Se3 pose_of(ObjectSummary const& object) {
  return {object.orientation, object.position_m};
}

TrueModel const* model_of(TrueModels const& models, std::string const& type) {
  auto const found = models.find(type);
  return found == models.end() ? nullptr : &found->second;
}

}  // namespace

bool is_where_believed(ObjectSummary const& believed, TrueThing const& thing,
                       TrueModels const& models) {
  if (!thing.present) {
    return false;
  }
  if (TrueModel const* const model = model_of(models, thing.type)) {
    return model->centre_distance_m(pose_of(believed), thing.pose) <= 0.5 * model->diameter_m();
  }
  return (believed.position_m - thing.pose.translation()).norm() <= 0.1;
}

void ObjectScorer::add_pose(FrameIndex frame, ObjectSummary const& believed, TrueThing const& thing,
                            TrueModel const* model) {
  Se3 const pose = pose_of(believed);
  Symmetry const symmetry = model != nullptr ? model->symmetry() : Symmetry{};
  TrueModel::PoseError const error =
      model != nullptr
          ? model->error(pose, thing.pose)
          : TrueModel::PoseError{(pose.translation() - thing.pose.translation()).norm(),
                                 pose.rotation().angularDistance(thing.pose.rotation())};
  translation_m_.add(error.translation_m);
  rotation_deg_.add(error.rotation_rad * 180.0 / std::numbers::pi);
  // A run's file is not ours to trust.
  if (believed.covariance.llt().info() == Eigen::ComputationInfo::Success) {
    PoseMatch const nees =
        match_pose({pose, believed.covariance}, {thing.pose, Matrix6d::Zero()}, symmetry);
    nees_.add(nees.squared_distance);
    degrees_of_freedom_.add(nees.degrees_of_freedom);
    repeated_.add(believed.id, believed.covariance, nees.degrees_of_freedom);
    claims_.push_back({frame, believed.id, nees.squared_distance, nees.degrees_of_freedom});
  }
}

void ObjectScorer::add(BeliefSummary const& belief, FrameTruth const& truth,
                       ToldObjects const& told,
                       std::vector<std::optional<std::size_t>> const& match,
                       TrueModels const& models) {
  for (TrueThing const& thing : truth.objects) {
    if (thing.present && thing.visible_fraction >= kSeenFraction) {
      seen_.insert(thing.id);
    }
  }
  std::set<std::string> recalled;
  std::set<std::string> within_tenth;
  for (std::size_t i = 0; i < belief.objects.size(); ++i) {
    ObjectSummary const& believed = belief.objects[i];
    TrueThing const* const thing = match[i] ? &truth.objects[*match[i]] : nullptr;
    if (believed.probability < kBelieved) {
      continue;
    }
    bool const right = thing != nullptr && is_where_believed(believed, *thing, models);
    precise_.add(right ? 1.0 : 0.0);
    if (!right) {
      continue;
    }
    recalled.insert(thing->id);
    TrueModel const* const model = model_of(models, thing->type);
    add_pose(belief.frame, believed, *thing, model);
    if (model != nullptr &&
        model->add_s_m(pose_of(believed), thing->pose) < 0.1 * model->diameter_m()) {
      within_tenth.insert(thing->id);
    }
  }
  for (TrueThing const& thing : truth.objects) {
    if (thing.present && told.told(thing.id) && seen_.contains(thing.id)) {
      recalled_.add(recalled.contains(thing.id) ? 1.0 : 0.0);
      if (model_of(models, thing.type) != nullptr) {
        within_tenth_.add(within_tenth.contains(thing.id) ? 1.0 : 0.0);
      }
    }
  }
}

ObjectScores ObjectScorer::scores() const {
  ObjectScores scores;
  scores.translation_m = translation_m_.value();
  scores.rotation_deg = rotation_deg_.value();
  scores.adds_recall = within_tenth_.value();
  scores.nees = nees_.value();
  scores.nees_expected = degrees_of_freedom_.value();
  if (scores.nees_expected) {
    auto const count = static_cast<double>(nees_.count());
    NeesBounds const bounds = nees_bounds(*scores.nees_expected * count, nees_.count());
    scores.nees_low = bounds.low;
    scores.nees_high = bounds.high;
    scores.nees_claims = repeated_.worth();
    NeesBounds const repeated = nees_bounds_of(*scores.nees_expected, *scores.nees_claims);
    scores.nees_repeated_low = repeated.low;
    scores.nees_repeated_high = repeated.high;
  }
  scores.precision = precise_.value();
  scores.recall = recalled_.value();
  scores.claims = claims_;
  return scores;
}

}  // namespace credo
