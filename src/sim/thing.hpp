#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/object_model.hpp"
#include "core/se3.hpp"
#include "core/solid.hpp"
#include "sim/scene.hpp"

namespace credo {

// Every thing here must have passed check_scene.

/// The bodies that a thing is made of: one, five for a table (its top, then its legs), those of its
/// model; none where that is a mesh.
std::vector<Solid> solids_of(SceneThing const& thing);

/// The mesh of a thing's model; null where it is made of bodies. It lives as long as the model.
TriangleMesh const* mesh_of(SceneThing const& thing);

/// Its texture, also where it is written as checker_m.
SceneTexture texture_of(SceneThing const& thing);

/// The box around a thing, in its own frame.
Eigen::AlignedBox3d bounds_of_thing(SceneThing const& thing);

/// The name of the model that a prior calls an object by: its type, else its model's name, else its
/// own.
std::string const& type_of(SceneThing const& thing);

/// T_world_thing.
Se3 pose_of(SceneThing const& thing);

}  // namespace credo
