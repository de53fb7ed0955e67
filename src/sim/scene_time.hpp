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

/// How many of Scene::events have happened at a time: between two frames where this is the same,
/// nothing has changed.
std::size_t event_count_at(Scene const& scene, double time_s);

/// What is there at an instant: position i is Scene::things[i], none while it is absent.
using PresentThings = std::vector<std::optional<SceneThing>>;

/// The things as they stand at a time.
PresentThings things_at(Scene const& scene, double time_s);

}  // namespace credo
