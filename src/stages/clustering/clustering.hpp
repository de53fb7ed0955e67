#pragma once

#include "core/cloud.hpp"
#include "core/fields.hpp"
#include "core/frame.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// Stuff (thesis 3.3 and algorithm 3); the thesis' numbers are marked T.
struct ClusteringConfig {
  /// Two points join one cluster within this distance (T: 0.05) ...
  double radius_m = 0.05;
  /// ... if their normals differ by less than this (T: 0.3).
  double max_angle_rad = 0.3;
  /// Clusters of fewer pixels (T: points with a normal) are ignored and stay unassigned (T: 25,
  /// where a Kinect leaves dozens of scraps in every frame).
  int min_pixels = 100;
  /// Pixels without a normal take a label from no farther than this in the image; see
  /// spread_labels.
  int spread_px = 5;
  /// Spacing of a cluster's points in the belief.
  double point_spacing_m = 0.02;
};
FieldList fields(ClusteringConfig& config);

/// Clusters what nothing else has explained: the pixels of `frame` that `segmentation` leaves
/// kUnassigned. Where it holds segments, each is a cluster, with all its pixels that are left, if a
/// piece of them that holds together (firm_runs) is large enough: objects, floor and walls leave
/// specks of what they have taken.
/// Without, clusters are what the thesis' algorithm 3 makes of the pixels that have a normal
/// (camera frame); then pixels without one take the label of what they touch, be it stuff, floor,
/// wall or object. Each cluster becomes a StuffCluster and gets a label, kFirstStuff + i by the
/// first pixel in raster order; should there be more than kMaxStuff, the largest stay.
///
/// Of segments, centroid, bounds and points leave out single pixels that lie apart (firm_runs), and
/// where a large one is close by they are those of every second or fourth pixel of every second or
/// fourth row (sampled_cells). A StuffCluster stands for all pixels that carry its label in the
/// end: pixel_count is their number, centroid (within the bounds) and points are theirs. The
/// entries of floor, walls and objects stay as they came: they count what made them. Nothing to
/// cluster gives no stuff. The segments go no further.
///
/// Throws std::logic_error where the sizes differ or `segmentation` already holds stuff.
[[nodiscard]] Segmentation cluster_stuff(Frame const& frame, NormalMap const& normals,
                                         Segmentation segmentation, ClusteringConfig const& config);

}  // namespace credo
