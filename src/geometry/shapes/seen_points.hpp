#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/frame.hpp"
#include "geometry/shapes/oriented_point.hpp"

namespace credo {

/// Points of a surface that one camera saw, and where it stood. One frame, metres.
struct SeenPoints {
  std::vector<Eigen::Vector3f> points;
  Eigen::Vector3f camera = Eigen::Vector3f::Zero();
};

/// What a frame shows within a box that is told in the frame of its poses. The result counts from
/// the middle of the box, along the same axes.
[[nodiscard]] SeenPoints seen_in(Frame const& frame, Eigen::AlignedBox3d const& box_source);

/// How far a point is from the next: the median over up to 300 points of each view, spread evenly.
/// 0 where no view has two points.
[[nodiscard]] float typical_pitch_m(std::vector<SeenPoints> const& views);

/// All points of all views with the normals of the planes through what the same view saw within
/// `radius_m` of each (principal component analysis), turned towards the camera. Left out are
/// points with fewer than 8 others so near, and those that the camera saw at a flatter angle than
/// 12 degrees: most of them lie on the edge of a shadow, on no surface at all.
[[nodiscard]] std::vector<OrientedPoint> with_normals(std::vector<SeenPoints> const& views,
                                                      float radius_m);

}  // namespace credo
