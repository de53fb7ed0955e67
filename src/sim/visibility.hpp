#pragma once

#include <cstddef>

#include "core/se3.hpp"
#include "sim/ray_caster.hpp"

namespace credo {

/// The share of a thing, world.things()[thing], that the caster's camera sees: of the pixels that
/// it would cover alone, in a picture without edges, those in the picture where it is the first
/// thing and in the range of depth. From at most about 64 x 64 rays, so to about one part in a
/// hundred for what is large enough. 0 for a thing that is absent, behind the camera, smaller than
/// a pixel, or a body that the camera is inside of. What lies farther beyond an edge than the
/// picture is wide or high is not counted.
double visible_fraction(RayCaster const& world, std::size_t thing, Se3 const& T_world_camera);

}  // namespace credo
