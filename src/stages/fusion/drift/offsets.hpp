#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// How far a block of a frame lies off a surface that is believed. World frame.
struct BlockOffset {
  /// What the frame measured.
  Eigen::Vector3d p_world;
  /// Unit, of the surface.
  Eigen::Vector3d normal_world;
  /// Of p from the surface, along the normal.
  double distance_m = 0.0;
  /// Standard deviation of that, of the sensor's noise and of what is believed.
  double sigma_m = 0.0;
};

enum class SurfaceKind : std::uint8_t { kGround, kWall, kThing };

/// What a frame says of one believed surface.
struct SurfaceOffsets {
  SurfaceKind kind = SurfaceKind::kGround;
  std::vector<BlockOffset> offsets;
  /// How far it counts, in [0, 1].
  double trust = 1.0;
};

/// A frame beside a belief: how far off the one lies from the other, by whatever pose of the
/// camera.
///
/// Blocks of the floor and of walls lie off the believed planes, a wall's off the wall that it is
/// by the pose that is expected. Points of the models of things, of which there is little doubt and
/// which a few looks showed, are looked for where they would be seen: there the frame's own surface
/// lies off them. Known objects and blocks without depth say nothing; nor does what is not finite.
class DriftView {
public:
  /// Both must outlive it. `expected`: of the camera, in the world that is believed.
  DriftView(BeliefState const& belief, Segmentation const& segmentation,
            Se3 const& T_world_camera_expected);

  /// Of blocks that lie off by no more than so many sigmas; surfaces without any are left out.
  [[nodiscard]] std::vector<SurfaceOffsets> offsets(Se3 const& T_world_camera,
                                                    double most_sigmas) const;

  /// Blocks that are looked at in each row and column: one in so many.
  static constexpr int kBlockStride = 3;
  /// Points that are looked at of each thing, at most.
  static constexpr std::size_t kPointsOfItem = 64;

private:
  struct PlaneBlocks {
    SurfaceKind kind = SurfaceKind::kGround;
    Plane plane_world;
    std::vector<Eigen::Vector3d> points_camera;
  };
  void gather_planes(BeliefState const& belief, Segmentation const& segmentation,
                     Se3 const& T_world_camera_expected);
  void gather_items(BeliefState const& belief);
  [[nodiscard]] SurfaceOffsets plane_offsets(PlaneBlocks const& blocks, Se3 const& T_world_camera,
                                             double most_sigmas) const;
  [[nodiscard]] SurfaceOffsets item_offsets(std::vector<Eigen::Vector3d> const& points_world,
                                            Se3 const& T_world_camera, double most_sigmas) const;

  Sight const& sight_;
  std::vector<PlaneBlocks> planes_;
  std::vector<std::vector<Eigen::Vector3d>> items_;
};

}  // namespace credo
