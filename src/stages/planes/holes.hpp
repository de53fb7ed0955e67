#pragma once

#include <vector>

#include "core/label.hpp"
#include "core/segmentation.hpp"
#include "stages/planes/plane_view.hpp"

namespace credo {

/// A floor or wall that has been found.
struct FoundSurface {
  LabelCode label;
  Plane camera;
};

/// Gives pixels that nothing has explained to floor and walls; the planes stay as fitted. Noise
/// turns normals before it moves points: with an angle to pass, a wall far away is full of holes.
/// And a plane that was neither floor nor wall may have taken some of theirs.
///
/// Of a segment that floor and walls hold most of together, the rest goes to the nearest of those
/// that hold more than a little of it, as far as it keeps near. Other pixels join where they all
/// but lie in a plane, whatever their normals.
void fill_holes(PlaneView const& view, std::vector<FoundSurface> const& found,
                Segmentation& segmentation);

}  // namespace credo
