#pragma once

#include <cstddef>
#include <vector>

#include "core/cloud.hpp"
#include "core/se3.hpp"
#include "geometry/shapes/object_shape.hpp"
#include "stages/region_growing/region_growing.hpp"

namespace credo {

/// A model at the pose at which it was detected.
struct PlacedShape {
  ObjectShape const* shape = nullptr;
  Se3 T_model_camera;
};

/// The pixels that may be of an object, each list in raster order.
struct ObjectPixels {
  /// Where its region may grow.
  std::vector<std::size_t> allowed;
  /// From where it grows; those without a normal are not among the allowed.
  std::vector<std::size_t> seeds;
};

[[nodiscard]] ObjectPixels object_pixels(OrganizedCloud const& cloud, NormalMap const& normals,
                                         PlacedShape const& placed,
                                         RegionGrowingConfig const& config);

}  // namespace credo
