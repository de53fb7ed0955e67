#pragma once

#include <vector>

#include "core/label.hpp"
#include "core/segmentation.hpp"
#include "stages/planes/plane_view.hpp"

namespace credo {

/// A floor or wall that has been found, or more of the same floor.
struct FoundSurface {
  LabelCode label;
  Plane camera;
  /// That carry its label by now.
  CountedPixels pixels;
  /// All others that may lie as near to the plane as its own, whatever their normals.
  PixelSet open;
};

/// Gives pixels that nothing has explained to floor and walls; the planes stay as fitted. Noise
/// turns normals before it moves points: with an angle to pass, a wall far away is full of holes.
/// And a plane that was neither floor nor wall may have taken some of theirs.
///
/// Of a segment that floor and walls hold most of together, the rest goes to the nearest of those
/// that hold more than a little of it, as far as it keeps near. Other pixels join where they all
/// but lie in a plane, whatever their normals.
/// `free`: all pixels that floor and walls could have, these surfaces' own among them
/// (unassigned_pixels() before the first was found).
void fill_holes(PlaneView const& view, std::vector<FoundSurface> const& found, CountedPixels free,
                Segmentation& segmentation);

}  // namespace credo
