#pragma once

#include <Eigen/Core>

#include "core/plane.hpp"
#include "core/se3.hpp"
#include "stages/capture/coarse_cloud.hpp"

namespace credo {

/// How a floor lies in a source frame that may be level already, and how wrong one frame can be
/// about it. Near the horizontal the floor is z = height_m + slope . (p - middle of what is seen).
struct FloorLean {
  /// Of the floor along the source's x and y.
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  Eigen::Matrix2d slope_covariance = Eigen::Matrix2d::Identity();
  /// Above the source's z = 0, in the middle of what is seen of it, where slope and height are
  /// known apart from each other; and one deviation of that.
  double height_m = 0.0;
  double height_deviation_m = 0.0;

  [[nodiscard]] double lean_rad() const;
  /// Whether the lean is one that a single frame's floor has by chance 95 times in 100, though the
  /// source is level.
  [[nodiscard]] bool may_be_level() const;
  /// The same of the height, of a source whose z = 0 is the floor.
  [[nodiscard]] bool may_be_at_zero() const;
};

/// `floor_camera` as find_floor gives it for `coarse`; its points are wrong by 2 mm + 1.5 mm/m^2
/// times the squared depth. A depth camera's steps run along the floor like the rows of its image,
/// so the errors of a row are taken for one error, however many points it has. A floor that is
/// steeper than 25 degrees in the source, or shows no slope, has an infinite slope: that source is
/// not level.
[[nodiscard]] FloorLean floor_lean(Plane const& floor_camera, CoarseCloud const& coarse,
                                   Se3 const& T_source_camera);

}  // namespace credo
