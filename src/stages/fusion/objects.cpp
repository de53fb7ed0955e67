#include "stages/fusion/objects.hpp"

#include <algorithm>
#include <utility>

#include "geometry/pose_fusion.hpp"

namespace credo {
namespace {

void see(ObjectBelief& object, ObjectObservation const& observation,
         Segmentation const& segmentation, FusionConfig const& config) {
  Look const look{segmentation.stamp_ns, segmentation.T_world_camera.translation()};
  ViewChange const since = object.last_seen ? view_change(*object.last_seen, look) : ViewChange{};
  double const news = novelty(since, object.pose_world.mean.translation(), config.existence);
  if (news > 0.0) {
    object.pose_world =
        updated_pose(object.pose_world, observation.pose_world, observation.symmetry,
                     {.weight = news, .min_covariance_share = config.objects.min_covariance_share});
  }
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

}  // namespace

std::vector<ObjectBelief> fused_objects(std::vector<ObjectBelief> objects,
                                        Segmentation const& segmentation, ViewChange const& change,
                                        FusionConfig const& config) {
  for (ObjectBelief& object : objects) {
    Evidence const before = std::exchange(object.evidence, Evidence::kNotSeen);
    object.label.reset();
    if (!segmentation.objects_looked_for) {
      continue;
    }
    double const news = novelty(change, object.pose_world.mean.translation(), config.existence);
    auto const observation =
        std::ranges::find(segmentation.objects, object.id, &ObjectObservation::object_id);
    if (observation != segmentation.objects.end()) {
      see(object, *observation, segmentation, config);
    } else {
      miss(object, news, config.objects);
    }
    object.log_odds =
        updated_log_odds(object.log_odds, before, object.evidence, news, config.existence);
  }
  return objects;
}

}  // namespace credo
