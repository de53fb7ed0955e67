#pragma once

#include <cstddef>

#include "core/cloud.hpp"
#include "geometry/plane_search.hpp"
#include "stages/planes/pixel_set.hpp"
#include "stages/planes/plane_pixels.hpp"

namespace credo {

/// Of the pixels, all of them valid, every so many-th in every so many-th row, that no more than
/// `most` are taken, as points to search for planes; a point's source is its pixel.
[[nodiscard]] PlaneSearchPoints sample_of(CountedPixels const& pixels, std::size_t most,
                                          OrganizedCloud const& cloud, NormalMap const& normals,
                                          PlaneTolerance const& tolerance);

}  // namespace credo
