#pragma once

#include <vector>

#include "core/truth.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene.hpp"
#include "sim/scene_caster.hpp"

namespace credo {

/// What is truly there in a frame of a scene. Walls are boxes; other
/// things of kind wall stand as segments along the longer side of what bounds them. Of events, a
/// swap is two things `moved`; a thing on its path is told as `moved` twice, in the frame where it
/// begins to move and in the one where it comes to rest (motions_at).
FrameTruth truth_of(SceneCaster& world, FrameIndex index);
/// The same of one frame alone. Throws InputError for a scene that check_scene refuses.
FrameTruth truth_of(Scene const& scene, FrameIndex index);

/// The label of each of Scene::things: floor 1000, walls from 2000, objects from 3000, stuff from
/// 4000, each kind counted in the scene's order.
std::vector<LabelCode> labels_of_things(Scene const& scene);

/// The true label image of a view: of the thing in each pixel, 0 where `measured_m`, of the same
/// size, has no depth, and on glass.
LabelMap true_labels(Scene const& scene, RenderedView const& view, Grid<float> const& measured_m);

}  // namespace credo
