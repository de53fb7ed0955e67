#include "stages/fusion/fusion.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "stages/fusion/drift/drift.hpp"
#include "stages/fusion/existence.hpp"
#include "stages/fusion/floor.hpp"
#include "stages/fusion/moved_segmentation.hpp"
#include "stages/fusion/objects/objects.hpp"
#include "stages/fusion/stuff/items.hpp"
#include "stages/fusion/stuff/stuff.hpp"
#include "stages/fusion/surroundings.hpp"
#include "stages/fusion/walls.hpp"

namespace credo {
namespace {

void fuse_surroundings(BeliefState& belief, Segmentation const& segmentation,
                       FusionConfig const& config) {
  // Before the frame adds its own points.
  SurroundingsLook look;
  if (config.visibility) {
    look = look_around(belief.floor, belief.walls, segmentation);
  }
  belief.floor = fused_floor(std::move(belief.floor), segmentation.floor, config.floor);
  std::optional<Eigen::Vector3d> camera_world;
  if (config.visibility) {
    camera_world = segmentation.T_world_camera.translation();
  }
  FusedWalls walls = fused_walls({std::move(belief.walls), belief.next_wall_id}, segmentation.walls,
                                 config.walls, camera_world);
  belief.walls = std::move(walls.walls);
  belief.next_wall_id = walls.next_id;
  if (config.visibility) {
    belief.floor = believed_floor(std::move(belief.floor), look.floor, segmentation, config);
    belief.walls = believed_walls(std::move(belief.walls), look.walls, segmentation, config);
  } else {
    take_for_granted(belief, segmentation, config);
  }
}

/// Of a frame whose pose is right.
BeliefState fuse_in_place(BeliefState prior, Segmentation const& segmentation,
                          FusionConfig const& config, KnownSurfaces const& surfaces) {
  ViewChange const change = view_change(prior, segmentation);
  BeliefState belief = std::move(prior);
  belief.frame = segmentation.frame;
  belief.stamp_ns = segmentation.stamp_ns;
  belief.segmented_with = segmentation.segmented_with;
  belief.T_world_camera = segmentation.T_world_camera;
  belief.T_world_told = segmentation.T_world_told;
  belief.objects = fused_objects(std::move(belief.objects), segmentation, change, surfaces, config);
  fuse_surroundings(belief, segmentation, config);
  FusedStuff stuff{std::move(belief.stuff), belief.next_stuff_id};
  stuff = config.visibility ? fused_items(std::move(stuff), segmentation,
                                          KnownPlaces(belief, surfaces), change.elapsed_s, config)
                            : fused_stuff(std::move(stuff), segmentation.stuff, change, config);
  belief.stuff = std::move(stuff.stuff);
  belief.next_stuff_id = stuff.next_id;
  if (config.visibility) {
    belief.last_sight = std::make_shared<PlacedSight const>(
        PlacedSight{segmentation.sight, segmentation.T_world_camera});
  }
  return belief;
}

}  // namespace

BeliefState fuse(BeliefState prior, Segmentation const& segmentation, FusionConfig const& config,
                 KnownSurfaces const& surfaces) {
  if (!config.drift.enabled) {
    return fuse_in_place(std::move(prior), segmentation, config, surfaces);
  }
  Se3 const T_world_told = tracked_drift(prior, segmentation, config.drift);
  return fuse_in_place(std::move(prior),
                       moved(segmentation, T_world_told * segmentation.T_world_told.inverse()),
                       config, surfaces);
}

}  // namespace credo
