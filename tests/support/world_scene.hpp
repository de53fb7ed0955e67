#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/frame.hpp"
#include "core/se3.hpp"
#include "core/segmentation.hpp"

namespace credo::test {

/// Where a camera stands: `height_m` above the floor, its axis along +y of the world, turned down
/// by `pitch_rad`.
Se3 camera_looking_along_y(double height_m, double pitch_rad);

/// Planes and boxes in the level world, z up.
struct WorldScene {
  std::vector<Plane> planes;
  struct Box {
    Eigen::Vector3d min_m;
    Eigen::Vector3d max_m;
  };
  std::vector<Box> boxes;

  /// The floor z = 0.
  WorldScene& with_floor();
  /// A wall across the view at y, towards the camera.
  WorldScene& with_wall(double y_m);
  WorldScene& with_box(Eigen::Vector3d const& min_m, Eigen::Vector3d const& max_m);
};

/// A frame with exact depth and the true normals.
struct Shot {
  Frame frame;
  NormalMap normals;
  Se3 T_world_camera;

  [[nodiscard]] Segmentation unassigned() const {
    return unassigned_segmentation(frame, T_world_camera, kPriorFrame);
  }
};

/// What a perfect 320x240 camera sees.
Shot shot_of(WorldScene const& scene, Se3 const& T_world_camera);

}  // namespace credo::test
