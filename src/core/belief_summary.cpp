#include "core/belief_summary.hpp"

#include <algorithm>
#include <iterator>

namespace credo {
namespace {

FloorSummary floor_summary(FloorBelief const& floor) {
  return {floor.normal,
          floor.height_m,
          floor.points->size(),
          probability_of(floor.log_odds),
          floor.log_odds,
          floor.evidence,
          floor.why};
}

WallSummary wall_summary(WallBelief const& wall) {
  return {wall.id,
          wall.segment_start_m,
          wall.segment_end_m,
          wall.plane_world.normal,
          wall.points->size(),
          wall.label,
          probability_of(wall.log_odds),
          wall.log_odds,
          wall.evidence,
          wall.why};
}

ObjectSummary object_summary(ObjectBelief const& object) {
  PoseDistribution const& pose = object.pose_world;
  return {object.id,
          object.type,
          probability_of(object.log_odds),
          pose.mean.translation(),
          pose.mean.rotation(),
          0.5 * (pose.covariance + pose.covariance.transpose()),
          object.evidence,
          object.label,
          object.log_odds,
          object.why};
}

StuffSummary stuff_summary(StuffBelief const& stuff) {
  StuffCluster const& latest = stuff.latest();
  return {stuff.id,
          probability_of(stuff.log_odds),
          stuff.history_count,
          latest.pixel_count,
          latest.centroid_world,
          latest.bounds_world.min(),
          latest.bounds_world.max(),
          stuff.evidence,
          stuff.label,
          stuff.log_odds,
          stuff.why,
          stuff.joined_ids};
}

}  // namespace

BeliefSummary summary_of(BeliefState const& belief) {
  BeliefSummary summary;
  summary.frame = belief.frame;
  summary.stamp_ns = belief.stamp_ns;
  summary.segmented_with = belief.segmented_with;
  summary.T_world_camera = belief.T_world_camera.matrix();
  if (belief.floor) {
    summary.floor = floor_summary(*belief.floor);
  }
  std::ranges::transform(belief.walls, std::back_inserter(summary.walls), wall_summary);
  std::ranges::transform(belief.objects, std::back_inserter(summary.objects), object_summary);
  std::ranges::transform(belief.stuff, std::back_inserter(summary.stuff), stuff_summary);
  return summary;
}

}  // namespace credo
