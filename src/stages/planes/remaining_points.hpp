#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/segments.hpp"
#include "geometry/plane_search.hpp"
#include "stages/planes/plane_view.hpp"

namespace credo {

/// What no plane has taken yet (thesis algorithm 2). Planes are found and fitted on a sample of it,
/// then every pixel is asked.
class RemainingPoints {
public:
  RemainingPoints(PlaneView const& view, Segments const& segments, CountedPixels pixels);

  /// Takes the largest plane out; none once it has fewer pixels than a plane must have.
  std::optional<PixelPlane> take_largest(std::uint32_t seed);

  /// Fits what a floor or wall has taken to the segments: all of those that it holds most of, as
  /// far as they keep near, and nothing of those that it holds little of.
  void settle(PixelPlane& plane);

private:
  /// How much of a segment a plane holds. The pixels that are on none are kPartly.
  enum class Held : std::uint8_t { kHardly, kPartly, kMostly };
  /// Noise turns normals before it moves points: once a plane holds some of a segment, all of its
  /// pixels that lie in the plane speak for it, whatever their normals.
  [[nodiscard]] std::vector<Held> held_of_segments(PixelPlane const& plane) const;
  [[nodiscard]] std::size_t segment_of(std::size_t pixel) const {
    return static_cast<std::size_t>(segments_.labels[pixel]);
  }
  void refresh_sample();
  [[nodiscard]] PixelPlane oriented(Plane const& camera, CountedPixels inliers) const;

  PlaneView const& view_;
  Segments const& segments_;
  CountedPixels pixels_;
  /// Of each segment, how many pixels neither floor nor wall nor object has taken. Empty without
  /// segments.
  std::vector<std::uint32_t> eligible_;
  PlaneSearchPoints sample_;
};

}  // namespace credo
