#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/frame.hpp"
#include "sim/scene.hpp"

namespace credo {

// A scene in time. Every scene here must have passed check_scene.

/// When a frame is taken, on the clock of the waypoints and events. Frames after the last waypoint
/// have a time too.
double scene_time_s(Scene const& scene, FrameIndex index);

/// How many of Scene::events have happened at a time.
std::size_t event_count_at(Scene const& scene, double time_s);

/// Whether things may stand otherwise at the second time than at the first: an event between, or
/// a thing that moves. What is built of the things at a time holds as long as this is false.
bool world_changes(Scene const& scene, double from_s, double to_s);

/// What is there at an instant: position i is Scene::things[i], none while it is absent. What moves
/// is told as if it stood where it is then.
using PresentThings = std::vector<std::optional<SceneThing>>;

/// The things as they stand at a time.
PresentThings things_at(Scene const& scene, double time_s);

/// Scene::things[thing] as it stands at a time or, while it is absent, as it stood before it was
/// removed, or will stand when it appears.
SceneThing last_known(Scene const& scene, std::size_t thing, double time_s);

/// The things, by their position, that begin to move on their paths in a frame or come to rest in
/// it: whose pose is new in this frame and was not in the one before, or will not be in the next.
/// None in the first frame; what is moving then begins to in the second. Absent things do not move.
std::vector<std::size_t> motions_at(Scene const& scene, FrameIndex index);

}  // namespace credo
