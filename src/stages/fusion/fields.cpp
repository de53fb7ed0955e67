#include "core/fields.hpp"

#include "stages/fusion/fusion.hpp"

namespace credo {

namespace {
// Certainty is never reached: its log-odds are infinite.
constexpr Range kProbability{1e-6, 1.0 - 1e-6};
}  // namespace

FieldList fields(ExistenceConfig& config) {
  return {
      {"seen_if_present", &config.seen_if_present, kProbability, "",
       "probability that a thing that is there is seen in a frame"},
      {"seen_if_absent", &config.seen_if_absent, kProbability, "",
       "probability that a thing that is not there is seen in a frame"},
      {"min_probability", &config.min_probability, {0, 1}, "", "stuff is forgotten below this"},
      {"max_log_odds",
       &config.max_log_odds,
       {0, 100},
       "",
       "bound on the log-odds either way; 0 = none"},
      {"correlation_time_s",
       &config.correlation_time_s,
       {0, 100},
       "s",
       "time over which frames repeat each other; 0 = every frame counts in full"},
      {"correlation_angle_rad",
       &config.correlation_angle_rad,
       {1e-3, 10},
       "rad",
       "turn of the line of sight over which frames repeat each other"},
  };
}

FieldList fields(ObjectFusionConfig& config) {
  return {
      {"min_covariance_share",
       &config.min_covariance_share,
       {0, 0.5},
       "",
       "part of a detection's covariance that no number of detections takes away"},
      {"unseen_relaxation",
       &config.unseen_relaxation,
       {0, 1},
       "",
       "how far a look in vain takes what is believed gone back to the prior's uncertainty"},
      {"never_found_share",
       &config.never_found_share,
       {0, 1},
       "",
       "with visibility: what shows no more of itself no detector finds"},
      {"surely_found_share",
       &config.surely_found_share,
       {0, 1},
       "",
       "with visibility: what shows so much of itself is found as surely as it ever is; above "
       "never_found_share"},
      {"never_found_px",
       &config.never_found_px,
       {1, 1e7},
       "pixels",
       "with visibility: what covers no more pixels with what it shows no detector finds"},
      {"surely_found_px",
       &config.surely_found_px,
       {1, 1e7},
       "pixels",
       "with visibility: what covers so many is found as surely as it ever is; above "
       "never_found_px"},
  };
}

FieldList fields(FloorFusionConfig& config) {
  return {
      {"point_spacing_m", &config.point_spacing_m, {1e-3, 1}, "m", "grid on which points are kept"},
      {"max_points", &config.max_points, {1, 1e7}, "", "points kept at most"},
  };
}

FieldList fields(WallFusionConfig& config) {
  return {
      {"max_normal_cross",
       &config.max_normal_cross,
       {0, 1},
       "",
       "two walls are parallel where the cross product of their normals is shorter"},
      {"max_offset_m",
       &config.max_offset_m,
       {0, 1},
       "m",
       "two walls are coplanar where the centroid of one is as near to the other's plane"},
      {"min_overlap_ratio",
       &config.min_overlap_ratio,
       {0, 1},
       "",
       "part of the shorter segment that two observations of one wall share"},
      {"segment_trim_ratio",
       &config.segment_trim_ratio,
       {0, 0.4},
       "",
       "part of an observation's points that may lie beyond each end of its segment"},
      {"merge_known",
       &config.merge_known,
       {},
       "",
       "walls of the belief that have come to match each other become one"},
      {"point_spacing_m", &config.point_spacing_m, {1e-3, 1}, "m", "grid on which points are kept"},
      {"max_points", &config.max_points, {1, 1e7}, "", "points kept of a wall, at most"},
  };
}

FieldList fields(StuffFusionConfig& config) {
  return {
      {"box_margin_m",
       &config.box_margin_m,
       {0, 10},
       "m",
       "bounding boxes this far apart still count as overlapping"},
      {"max_icp_points",
       &config.max_icp_points,
       {8, 10000},
       "",
       "points of a cluster that ICP sees, at most"},
      {"point_spacing_m",
       &config.point_spacing_m,
       {1e-3, 1},
       "m",
       "finest grid on which clusters are thinned for ICP"},
      {"max_icp_iterations",
       &config.max_icp_iterations,
       {0, 1000},
       "",
       "iterations of ICP, at most"},
      {"min_icp_step_m",
       &config.min_icp_step_m,
       {0, 1},
       "m",
       "ICP has converged when it moves no point by more"},
      {"max_rms_m",
       &config.max_rms_m,
       {0, 10},
       "m",
       "distance after ICP beyond which clusters are not the same; 0 = no limit"},
      {"max_displacement_m",
       &config.max_displacement_m,
       {0, 100},
       "m",
       "motion by ICP beyond which clusters are not the same; 0 = no limit"},
      {"kept_clusters",
       &config.kept_clusters,
       {1, 1000},
       "",
       "clusters kept of the history of a thing"},
  };
}

FieldList fields(BirthConfig& config) {
  return {
      {"log_odds",
       &config.log_odds,
       {-10, 10},
       "",
       "log-odds of what is as thick as one block of the sight, a 160th of the image's width"},
      {"per_log_thickness",
       &config.per_log_thickness,
       {0, 10},
       "",
       "added for each time that it is e times as thick"},
      {"arrived_probability", &config.arrived_probability, kProbability, "",
       "at most, of what stands where the frame before saw through"},
  };
}

FieldList fields(DriftConfig& config) {
  return {
      {"enabled", &config.enabled, {}, "", "poses are corrected before frames are fused"},
      {"step_m",
       &config.step_m,
       {1e-6, 1},
       "m",
       "how much the correction is expected to change from frame to frame, standard deviation"},
      {"step_rad", &config.step_rad, {1e-6, 1}, "rad", "the same of its turn"},
      {"max_m", &config.max_m, {0, 10}, "m", "how far it may take the camera"},
      {"max_rad", &config.max_rad, {0, 1}, "rad", "how far it may turn the camera"},
  };
}

FieldList fields(FusionConfig& config) {
  return {
      {"visibility",
       &config.visibility,
       {},
       "",
       "what is hidden or out of view keeps its probability, what is seen through loses it; false: "
       "as the thesis has it"},
      {"prior_probability", &config.prior_probability, kProbability, "",
       "that a known object is there; without visibility also what is seen for the first time"},
      {"new_probability", &config.new_probability, kProbability, "",
       "with visibility: that a floor or a wall seen for the first time is there"},
      section("existence", fields(config.existence),
              "how observations move the probability that a thing is there"),
      section("drift", fields(config.drift),
              "how the poses that frames tell are corrected against what is believed"),
      section("objects", fields(config.objects),
              "how the pose of a known object is learnt and forgotten"),
      section("floor", fields(config.floor), "how observations of the floor add up"),
      section("walls", fields(config.walls), "when two walls are one"),
      section("stuff", fields(config.stuff), "when a cluster is a thing seen before"),
      section("births", fields(config.births),
              "with visibility: how likely a cluster that nothing explains is a thing"),
  };
}

}  // namespace credo
