#include "stages/fusion/objects/places.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cstddef>
#include <optional>
#include <utility>

#include "geometry/pose_fusion.hpp"
#include "stages/fusion/existence.hpp"

namespace credo {
namespace {

/// Log-odds of a place where an object was found once. Below even: detectors err.
constexpr double kFoundOnce = -1.0;
/// Log-odds that take an object to another place although nothing says that it has gone.
constexpr double kSure = 2.0;
/// Two detections of one place agree within this quantile.
constexpr double kSamePlace = 0.999;

bool is_same_place(PoseDistribution const& a, PoseDistribution const& b, Symmetry const& symmetry) {
  PoseMatch const match = match_pose(a, b, symmetry);
  return match.squared_distance <=
         boost::math::quantile(boost::math::chi_squared(match.degrees_of_freedom), kSamePlace);
}

/// What was found there before is found again, or found for the first time.
OtherPlace found(std::optional<OtherPlace> const& before, FoundPose const& found, Look const& now,
                 Symmetry const& symmetry, FusionConfig const& config) {
  if (!before || !is_same_place(before->pose_world, found.pose_world, symmetry)) {
    return {found.pose_world, kFoundOnce, now};
  }
  double const news = novelty(view_change(before->last_seen, now),
                              found.pose_world.mean.translation(), config.existence);
  OtherPlace place = *before;
  place.pose_world = pose_after(place.pose_world, found, news, symmetry, config.objects);
  place.log_odds =
      updated_log_odds(place.log_odds, Evidence::kSeen, Evidence::kSeen, news, config.existence);
  place.last_seen = now;
  return place;
}

/// Those that the frame did not show, the least believed first.
std::vector<std::size_t> missing_objects(std::vector<ObjectBelief> const& objects) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].evidence != Evidence::kSeen) {
      missing.push_back(i);
    }
  }
  std::ranges::stable_sort(missing, {}, [&](std::size_t i) { return objects[i].log_odds; });
  return missing;
}

/// Of the object's type and at no known object's place: the first one at the place where it was
/// found before, else the first.
std::optional<std::size_t> detection_for(ObjectBelief const& object,
                                         std::optional<OtherPlace> const& before,
                                         std::vector<RefusedDetection> const& refused,
                                         std::vector<bool> const& taken, Symmetry const& symmetry) {
  std::optional<std::size_t> first;
  for (std::size_t d = 0; d < refused.size(); ++d) {
    bool const at_known_place = refused[d].squared_distance <= refused[d].max_squared_distance;
    if (taken[d] || refused[d].type != object.type || at_known_place) {
      continue;
    }
    if (before && is_same_place(before->pose_world, refused[d].pose_world, symmetry)) {
      return d;
    }
    first = first ? first : d;
  }
  return first;
}

void go_there(ObjectBelief& object, OtherPlace const& place) {
  object.why.moved += place.log_odds - object.log_odds;
  object.pose_world = place.pose_world;
  object.log_odds = place.log_odds;
  object.last_seen = place.last_seen;
  object.last_look = place.last_seen;
  object.verdict = Verdict::kSeen;
  object.evidence = Evidence::kSeen;
}

}  // namespace

PoseDistribution pose_after(PoseDistribution const& before, FoundPose const& found, double news,
                            Symmetry const& symmetry, ObjectFusionConfig const& config) {
  PoseUpdate const update =
      found.errors_repeat
          ? PoseUpdate{.weight = news, .min_covariance_share = config.min_covariance_share}
          : PoseUpdate{};
  return update.weight > 0.0 ? updated_pose(before, found.pose_world, symmetry, update) : before;
}

std::vector<ObjectBelief> moved_objects(std::vector<ObjectBelief> objects,
                                        Segmentation const& segmentation,
                                        KnownSurfaces const& surfaces, FusionConfig const& config) {
  if (!segmentation.objects_looked_for) {
    return objects;
  }
  Look const now{segmentation.stamp_ns, segmentation.T_world_camera.translation()};
  std::vector<std::optional<OtherPlace>> before;
  before.reserve(objects.size());
  for (ObjectBelief& object : objects) {
    before.push_back(std::exchange(object.other_place, std::nullopt));
  }
  std::vector<bool> taken(segmentation.refused.size(), false);
  for (std::size_t const i : missing_objects(objects)) {
    auto const surface = surfaces.find(objects[i].type);
    if (surface == surfaces.end()) {
      continue;
    }
    Symmetry const& symmetry = surface->second.symmetry;
    std::optional<std::size_t> const detection =
        detection_for(objects[i], before[i], segmentation.refused, taken, symmetry);
    if (detection) {
      taken[*detection] = true;
      RefusedDetection const& there = segmentation.refused[*detection];
      objects[i].other_place =
          found(before[i], {there.pose_world, there.errors_repeat}, now, symmetry, config);
    }
  }
  for (ObjectBelief& object : objects) {
    double const enough = object.verdict == Verdict::kSeen ? kSure : object.log_odds;
    if (object.other_place && object.other_place->log_odds > enough) {
      go_there(object, *std::exchange(object.other_place, std::nullopt));
    }
  }
  return objects;
}

}  // namespace credo
