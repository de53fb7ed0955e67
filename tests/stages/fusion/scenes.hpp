#pragma once

#include <Eigen/Core>

#include "core/belief.hpp"
#include "core/segmentation.hpp"
#include "stages/fusion/fusion.hpp"

// Hand-made segmentations, world frame.
namespace credo::test {

/// The numbers of the thesis: every frame counts in full, nothing is bounded, the sum decides.
FusionConfig thesis_config();

/// The visible sides (x-, y-, top) of a box that stands at `corner`, one point every 2 cm.
StuffCluster box_cluster(LabelCode label, Eigen::Vector3f const& corner,
                         Eigen::Vector3f const& size);
/// A cluster with these points, its bounds and centroid.
StuffCluster cluster_of(LabelCode label, PointList points);

/// A wall with its foot from `start` to `end`, 2 m high, one point every 10 cm, its normal to the
/// left of that direction.
WallObservation wall(LabelCode label, Eigen::Vector2d const& start, Eigen::Vector2d const& end);

/// Level, from `min` to `max`, one point every 10 cm.
FloorObservation floor_patch(Eigen::Vector2f const& min, Eigen::Vector2f const& max,
                             float height_m);

/// An empty frame `number` at 30 Hz from a camera that stands at the origin.
Segmentation empty_segmentation(int number);

/// The frame as it would be if the world were turned and shifted.
Segmentation moved(Se3 const& motion, Segmentation segmentation);

}  // namespace credo::test
