#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/cloud.hpp"
#include "core/plane.hpp"
#include "stages/planes/pixel_set.hpp"
#include "stages/planes/plane_pixels.hpp"

namespace credo {

/// Bounds of the points of each word of 64 pixels: most words lie far from a plane, and none of
/// their points need be asked.
class PixelBoxes {
public:
  explicit PixelBoxes(OrganizedCloud const& cloud);

  /// Those of the pixels `among` in words that may hold a point within the tolerance of the plane.
  [[nodiscard]] PixelSet near(Plane const& plane_camera, PixelSet const& among,
                              PlaneTolerance const& tolerance) const;

private:
  using Axes = std::array<std::vector<float>, 3>;

  /// Infinite, and the wrong way round, where a word has no valid point.
  Axes least_;
  Axes greatest_;
};

}  // namespace credo
