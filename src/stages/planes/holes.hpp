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

/// Noise turns normals before it moves points: with an angle to pass, a wall far away is full of
/// holes. And a plane that was neither floor nor wall may have taken some of theirs. So pixels that
/// nothing has explained join floor or wall where they all but lie in it, whatever their normals;
/// the planes themselves stay as fitted.
void fill_holes(PlaneView const& view, std::vector<FoundSurface> const& found,
                Segmentation& segmentation);

}  // namespace credo
