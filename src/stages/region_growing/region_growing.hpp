#pragma once

#include <span>

#include "core/cloud.hpp"
#include "core/fields.hpp"
#include "core/frame.hpp"
#include "core/segmentation.hpp"
#include "geometry/shapes/object_shape.hpp"

namespace credo {

/// The points of known objects (thesis 3.1.2 and algorithm 1); the thesis' numbers are marked T.
struct RegionGrowingConfig {
  /// A point within this distance of a point of the region (T: 0.03) ...
  double radius_m = 0.03;
  /// ... whose normals differ by less than this joins it (T: 0.3).
  double max_angle_rad = 0.3;
  /// The region stays within the model's bounding box, so much larger on each side ("loosely") ...
  double bounds_margin_m = 0.03;
  /// ... and within this distance of the model's surface, or inside, or where it is seeded (T: no
  /// such limit). A cat's bounding box holds more desk than cat.
  double max_distance_m = 0.02;
  /// Points of a region have a normal within this angle of that of the model's nearest surface, so
  /// that a table is not taken for the box on it: less than a right angle, but not much, because
  /// normals of small things are blurred; pi or more switches it off (T).
  double max_model_angle_rad = 1.2;
  /// ... or of that of another face within this distance: at a crease a pixel's normal is blended
  /// from both sides, and which face is nearest tells nothing.
  double crease_radius_m = 0.005;
  /// Points within this distance outside the model seed its region like those inside (T: 0): a pose
  /// that is off by a little must not lose a whole face.
  double seed_distance_m = 0.01;
  /// The same for a mesh with holes, which has no inside.
  double open_mesh_distance_m = 0.015;
  /// Grown where the belief and the detection together have the object; else where the detection
  /// alone has it (T). One detection is off by more than many: a turn of a degree takes a table's
  /// legs out of reach.
  bool from_belief = true;
};
FieldList fields(RegionGrowingConfig& config);

/// Labels the pixels of each observed object: kFirstObject + its position in the belief. `shapes`
/// has the models by name; an observation whose type is not there is left without pixels.
///
/// The seeds of all objects are claimed before anything grows, objects in the order of the
/// observations; then each grows over pixels that nothing has claimed, as algorithm 1 says, never
/// out of its limits. Only pixels that come kUnassigned are taken. What is reached is exactly what
/// the algorithm reaches, pixel for pixel: the components of the graph of reachability.hpp that
/// hold a seed. Pixels without a normal are seeds at most, where max_model_angle_rad is off, and
/// nothing grows from them.
///
/// Throws std::logic_error where the sizes of cloud, normals and labels differ.
[[nodiscard]] Segmentation grow_objects(Frame const& frame, NormalMap const& normals,
                                        Segmentation segmentation, ObjectShapes const& shapes,
                                        RegionGrowingConfig const& config);

/// The same from where the objects are said to be instead of where they were detected: one pose an
/// observation. By as much as its farthest point may be off (one deviation) the limits of distance
/// are wider.
[[nodiscard]] Segmentation grow_objects(Frame const& frame, NormalMap const& normals,
                                        Segmentation segmentation,
                                        std::span<PoseDistribution const> poses_world,
                                        ObjectShapes const& shapes,
                                        RegionGrowingConfig const& config);

}  // namespace credo
