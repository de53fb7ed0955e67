#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/object_model.hpp"
#include "core/se3.hpp"
#include "sim/scene.hpp"

namespace credo {

/// A thing on the table: a known object by its model's name, or something that no model is of.
struct TabletopThing {
  /// Empty for an unknown thing.
  std::string model;
  /// Of an unknown one.
  SceneShape shape = SceneShape::kBox;
  std::vector<double> size_m;
  /// In the world.
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy_deg = Eigen::Vector3d::Zero();
};

/// A table top with things on it, a floor, a wall behind it, and one look at them. The table's
/// middle is the world's z axis; the wall is where y is positive.
struct TabletopScene {
  std::string name;
  /// Of the sensor's noise.
  int seed = 1;
  Eigen::Vector3d camera_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d look_at_m = Eigen::Vector3d::Zero();
  double wall_y_m = 1.0;
  std::vector<TabletopThing> things;
};

/// Upper side of the table [m], and its size along x and y.
inline constexpr double kTabletopHeight_m = 0.74;
inline constexpr double kTabletopWidth_m = 1.4;
inline constexpr double kTabletopDepth_m = 0.9;

/// Lines of text, lengths to a tenth of a millimetre, turns to a hundredth of a degree:
/// what text_of has written, scenes_in reads back to the last digit.
[[nodiscard]] std::string text_of(std::vector<TabletopScene> const& scenes);
/// Throws InputError naming `where` and the line that is not as it must be.
[[nodiscard]] std::vector<TabletopScene> scenes_in(std::string const& text,
                                                   std::string const& where);

/// The scene to render, its known objects of kind object under their models' names. Throws
/// InputError for a model that is not in `models`.
[[nodiscard]] Scene scene_of(TabletopScene const& tabletop, ObjectModels const& models);

}  // namespace credo
