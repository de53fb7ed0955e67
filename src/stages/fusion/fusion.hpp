#pragma once

#include <cstdint>

#include "core/belief.hpp"
#include "core/fields.hpp"
#include "core/segmentation.hpp"
#include "geometry/shapes/known_surface.hpp"

namespace credo {

/// How observations move the probability that a thing is there (thesis equation 4.1).
struct ExistenceConfig {
  /// P(seen | there), and P(not seen | not there) = 1 - P(seen | not there).
  double seen_if_present = 0.95;
  double seen_if_absent = 0.05;
  /// Stuff is forgotten below this.
  double min_probability = 0.15;
  /// Bound on |log-odds|, so that what was seen for long is not believed for long after it went; 0
  /// for none.
  double max_log_odds = 4.6;
  /// Over how long, and over what turn of the line of sight, frames repeat each other
  /// (existence.hpp). A time of 0 counts every frame in full.
  double correlation_time_s = 0.25;
  double correlation_angle_rad = 0.175;
};
FieldList fields(ExistenceConfig& config);

/// How the pose of a known object is learnt and forgotten (thesis algorithm 4 never forgets: T).
struct ObjectFusionConfig {
  /// The part of a detection's covariance that no number of looks takes away, because a detector's
  /// errors have it in common (T: 0).
  double min_covariance_share = 0.05;
  /// What is looked for in vain may have been moved: the less it is believed to be there, the more
  /// its pose goes back to the uncertainty of the prior: so much of the way for a look at what is
  /// believed to be gone (T: 0, never).
  double unseen_relaxation = 0.1;
  // Of the rule that knows what it could not see: a detector finds nothing of which no more than
  // the first part is visible, and what is there as surely as it ever does from the second on.
  double never_found_share = 0.1;
  double surely_found_share = 0.2;
  /// Likewise by the pixels that the visible part covers, in which range and incidence come
  /// together; between the two it rises with their logarithm.
  double never_found_px = 200.0;
  double surely_found_px = 2500.0;
};
FieldList fields(ObjectFusionConfig& config);

/// How observations of the floor add up (thesis 4.2).
struct FloorFusionConfig {
  double point_spacing_m = 0.05;
  /// A floor that has as many points takes no more; its plane is still updated.
  int max_points = 50000;
};
FieldList fields(FloorFusionConfig& config);

/// When two walls are one, and how they add up (thesis 4.2, algorithm 5).
struct WallFusionConfig {
  /// Least that the norm of the cross product of two walls' normals must be for them to differ.
  double max_normal_cross = 0.1;
  double max_offset_m = 0.05;
  /// Common part of two segments, of the shorter one.
  double min_overlap_ratio = 0.4;
  /// Part of an observation's points that may lie beyond each end of its segment.
  double segment_trim_ratio = 0.005;
  /// Walls of the belief that have come to match each other become one.
  bool merge_known = true;
  double point_spacing_m = 0.05;
  /// A wall that has as many points takes no more; its plane and segment are still updated.
  int max_points = 20000;
};
FieldList fields(WallFusionConfig& config);

/// When a cluster is a thing that the belief holds, and what is kept of it, by the thesis' rule
/// (4.3, algorithm 6).
struct StuffFusionConfig {
  /// Bounding boxes this far apart still count as overlapping.
  double box_margin_m = 0.02;
  /// ICP sees at most as many points of a cluster, 8 or more, thinned from `point_spacing_m`
  /// upward.
  int max_icp_points = 64;
  double point_spacing_m = 0.02;
  int max_icp_iterations = 10;
  double min_icp_step_m = 1e-3;
  /// Limits to what ICP may do to call two clusters the same; 0 for none. Half the spacing of the
  /// thinned points is added to the RMS: two samples of one surface differ by that much.
  double max_rms_m = 0.03;
  double max_displacement_m = 0.15;
  /// Clusters kept of a history; older ones are counted only.
  int kept_clusters = 3;
};
FieldList fields(StuffFusionConfig& config);

/// How likely a cluster is a thing of its own that nothing explains, when it is seen for the first
/// time, with the rule that knows what it could not see: log-odds that grow with the logarithm of
/// its thickness (thickness.hpp) in the blocks of the sight, about 160 to a row. Fitted on
/// simulated scenes (docs/belief.md).
struct BirthConfig {
  double log_odds = -0.15;
  double per_log_thickness = 1.8;
  /// At most, of what stands where the frame before saw through: it may be a known object that was
  /// moved there.
  double arrived_probability = 0.9;
};
FieldList fields(BirthConfig& config);
[[nodiscard]] double birth_log_odds(double thickness_blocks, bool arrived,
                                    BirthConfig const& config, ExistenceConfig const& existence);

/// How the poses that frames tell are corrected against what is believed (drift.hpp; T: not at
/// all).
struct DriftConfig {
  bool enabled = false;
  /// How much the correction is expected to change from frame to frame, standard deviations along
  /// and about each axis.
  double step_m = 0.005;
  double step_rad = 0.005;
  /// How far from what is told it may take the camera.
  double max_m = 0.3;
  double max_rad = 0.15;
};
FieldList fields(DriftConfig& config);

struct FusionConfig {
  /// The rule that knows what it could not see (stuff/items.hpp, objects/objects.hpp,
  /// surroundings.hpp); else the thesis'.
  bool visibility = true;
  /// That a known object is there; with the thesis' rule also what is seen for the first time.
  double prior_probability = 0.99;
  /// That a floor or a wall seen for the first time is there, with the rule that knows what it
  /// could not see.
  double new_probability = 0.7;
  ExistenceConfig existence;
  DriftConfig drift;
  ObjectFusionConfig objects;
  FloorFusionConfig floor;
  WallFusionConfig walls;
  StuffFusionConfig stuff;
  BirthConfig births;
};
FieldList fields(FusionConfig& config);

/// The belief after one more frame (thesis chapter 4). `prior` is the belief after the frame
/// before, whatever belief the frame was segmented with. World frame throughout.
///
/// Total: an empty segmentation is a frame in which nothing was seen. Planes without a finite point
/// and clusters without points are passed over. Objects are found again by id; one that the belief
/// does not hold is passed over.
///
/// `surfaces`: of known objects, by type. One without is believed by the thesis' rule.
[[nodiscard]] BeliefState fuse(BeliefState prior, Segmentation const& segmentation,
                               FusionConfig const& config, KnownSurfaces const& surfaces = {});

}  // namespace credo
