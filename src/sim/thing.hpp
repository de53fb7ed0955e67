#pragma once

#include <string>
#include <vector>

#include "core/se3.hpp"
#include "core/solid.hpp"
#include "sim/scene.hpp"

namespace credo {

/// The bodies that a thing is made of: one, or five for a table (its top, then its legs). The thing
/// must have passed check_scene.
std::vector<Solid> solids_of(SceneThing const& thing);

/// The name of the model that a prior calls an object by.
std::string const& type_of(SceneThing const& thing);

/// T_world_thing.
Se3 pose_of(SceneThing const& thing);

}  // namespace credo
