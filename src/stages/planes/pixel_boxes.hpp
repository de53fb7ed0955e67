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
/// their points need be asked. Found once they are first needed: a frame may show nothing that
/// could be floor or wall. For one thread.
class PixelBoxes {
public:
  /// `cloud` outlives this.
  explicit PixelBoxes(OrganizedCloud const& cloud) : cloud_(&cloud) {}

  /// Those of the pixels `among` in words that may hold a point within the tolerance of the plane.
  [[nodiscard]] PixelSet near(Plane const& plane_camera, PixelSet const& among,
                              PlaneTolerance const& tolerance) const;

  struct Behind {
    /// In words of which all points lie clear behind the plane.
    CountedPixels certain;
    /// In words of which some may.
    PixelSet open;
  };
  /// What the boxes say of which of the pixels `among`, all of them valid, lie clear of the plane
  /// on the side that its normal does not point to.
  [[nodiscard]] Behind behind(Plane const& plane_camera, PixelSet const& among,
                              PlaneTolerance const& tolerance) const;

private:
  /// Of a plane and each box: the least and the greatest distance of its points.
  class Distances;
  using Axes = std::array<std::vector<float>, 3>;

  void bound() const;

  OrganizedCloud const* cloud_;
  /// Infinite, and the wrong way round, where a word has no valid point.
  mutable Axes least_;
  mutable Axes greatest_;
};

}  // namespace credo
