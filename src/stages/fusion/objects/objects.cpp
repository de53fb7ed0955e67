#include "stages/fusion/objects/objects.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "stages/fusion/findings.hpp"
#include "stages/fusion/objects/looks.hpp"
#include "stages/fusion/objects/places.hpp"

namespace credo {
namespace {

void see(ObjectBelief& object, ObjectObservation const& observation,
         Segmentation const& segmentation, FusionConfig const& config) {
  Look const look{segmentation.stamp_ns, segmentation.T_world_camera.translation()};
  ViewChange const since = object.last_seen ? view_change(*object.last_seen, look) : ViewChange{};
  double const news = novelty(since, object.pose_world.mean.translation(), config.existence);
  object.pose_world =
      pose_after(object.pose_world, {observation.pose_world, observation.errors_repeat}, news,
                 observation.symmetry, config.objects);
  object.last_seen = look;
  object.evidence = Evidence::kSeen;
  if (observation.pixel_count > 0) {
    object.label = observation.label;
  }
}

/// `news` of a look in vain.
void miss(ObjectBelief& object, double news, ObjectFusionConfig const& config) {
  if (object.prior_covariance) {
    double const gone = 1.0 - probability_of(object.log_odds);
    Matrix6d& covariance = object.pose_world.covariance;
    covariance += config.unseen_relaxation * news * gone * (*object.prior_covariance - covariance);
  }
}

ObjectObservation const* observation_of(ObjectBelief const& object,
                                        Segmentation const& segmentation) {
  auto const found =
      std::ranges::find(segmentation.objects, object.id, &ObjectObservation::object_id);
  return found != segmentation.objects.end() ? &*found : nullptr;
}

/// The thesis' rule: what was not found is the less likely to be there, for whatever reason.
void update(ObjectBelief& object, Segmentation const& segmentation, ViewChange const& change,
            FusionConfig const& config) {
  Evidence const before = std::exchange(object.evidence, Evidence::kNotSeen);
  object.why.news = novelty(change, object.pose_world.mean.translation(), config.existence);
  if (ObjectObservation const* const observation = observation_of(object, segmentation)) {
    see(object, *observation, segmentation, config);
  } else {
    miss(object, object.why.news, config.objects);
  }
  double const moved_to =
      updated_log_odds(object.log_odds, before, object.evidence, object.why.news, config.existence);
  object.why.moved = moved_to - object.log_odds;
  object.log_odds = moved_to;
}

/// How much likelier this look is if the object is there.
double likelihood_ratio(ObjectLook const& look, bool found, ExistenceConfig const& config) {
  double const found_ratio = config.seen_if_present / config.seen_if_absent;
  return found ? found_ratio : look.missed_if_there / (1.0 - look.found_if_there / found_ratio);
}

/// The rule that knows what could not be seen.
void update(ObjectBelief& object, Segmentation const& segmentation, ObjectLook const& look,
            FusionConfig const& config) {
  Look const now{segmentation.stamp_ns, segmentation.T_world_camera.translation()};
  ViewChange const since = object.last_look ? view_change(*object.last_look, now) : ViewChange{};
  double const news = novelty(since, object.pose_world.mean.translation(), config.existence);
  object.why = {.points = look.points, .visible_share = look.visible_share, .news = news};
  object.evidence = evidence_of(look.points, std::nullopt);
  ObjectObservation const* const observation = observation_of(object, segmentation);
  double const ratio = likelihood_ratio(look, observation != nullptr, config.existence);
  if (ratio == 1.0) {
    return;
  }
  bool const seen_through =
      look.points[PointState::kSeenThrough] > look.points[PointState::kAgrees];
  if (observation != nullptr) {
    see(object, *observation, segmentation, config);
  } else {
    object.evidence = seen_through ? Evidence::kSeenThrough : Evidence::kNotSeen;
    // Where the depths fit it stands where it did, whoever does not find it.
    if (ratio < 1.0) {
      miss(object, news, config.objects);
    }
  }
  Verdict const verdict = observation != nullptr ? Verdict::kSeen : Verdict::kGone;
  double const counts = verdict != object.verdict ? 1.0 : news;
  add_step(object.log_odds, log_odds_step(ratio, counts), object.why, config.existence);
  object.verdict = verdict;
  object.last_look = now;
}

}  // namespace

std::vector<ObjectBelief> fused_objects(std::vector<ObjectBelief> objects,
                                        Segmentation const& segmentation, ViewChange const& change,
                                        KnownSurfaces const& surfaces, FusionConfig const& config) {
  std::optional<ObjectLooks> looks;
  if (config.visibility) {
    looks.emplace(segmentation.sight, segmentation.T_world_camera, config);
  }
  for (ObjectBelief& object : objects) {
    object.label.reset();
    object.why = {};
    if (!segmentation.objects_looked_for) {
      object.evidence = Evidence::kNotSeen;
      continue;
    }
    auto const surface = surfaces.find(object.type);
    if (looks && surface != surfaces.end()) {
      update(object, segmentation, looks->look_at(object.pose_world, surface->second), config);
    } else {
      update(object, segmentation, change, config);
    }
  }
  return config.visibility ? moved_objects(std::move(objects), segmentation, surfaces, config)
                           : std::move(objects);
}

}  // namespace credo
