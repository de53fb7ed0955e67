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
/// then every pixel is asked. Where there are segments, these suggest planes; else the largest
/// one of all is looked for, time and again.
class RemainingPoints {
public:
  RemainingPoints(PlaneView const& view, Segments const& segments, CountedPixels pixels);

  /// Takes the largest plane out; none once it has fewer pixels than a plane must have.
  std::optional<PixelPlane> take_largest(std::uint32_t seed);

  /// Planes that segments suggest, each to be taken in turn: see segment_planes().
  [[nodiscard]] std::vector<Plane> suggested();
  /// Takes one of these out, fitted to all that lies in it; none where too little is left of it, or
  /// where the sample tells that an upright one is no wall.
  std::optional<PixelPlane> take(Plane const& suggested);

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
  [[nodiscard]] bool is_upright(Plane const& plane_camera) const;
  /// Takes out the pixels of a plane that has been found in the sample.
  std::optional<PixelPlane> take_found(FoundPlane const& found);
  /// Fitted to the segment that has most of its points in it, and to those that are coplanar with
  /// that one: a plane laid through a wall and the door before it, between both, turns to one.
  [[nodiscard]] FoundPlane fitted_to_segments(FoundPlane found) const;
  /// Of each segment, the mean signed distance of its flagged sample points, in tolerances.
  [[nodiscard]] std::vector<double> mean_distances(Plane const& plane,
                                                   std::vector<std::uint8_t> const& flags) const;
  /// A flag for each point of the sample: whether `test(point, segment)`.
  template <typename Test>
  [[nodiscard]] std::vector<std::uint8_t> flags_where(Test const& test) const {
    std::vector<std::uint8_t> flags(sample_.size());
    for (std::size_t i = 0; i < flags.size(); ++i) {
      flags[i] = test(i, segment_of(sample_.source[i])) ? 1 : 0;
    }
    return flags;
  }
  [[nodiscard]] bool may_be_wall(FoundPlane const& found) const;
  [[nodiscard]] PixelPlane oriented(Plane const& camera, PlanePixels pixels) const;

  PlaneView const& view_;
  Segments const& segments_;
  /// What there was at first.
  PixelSet all_;
  CountedPixels pixels_;
  /// Of each segment, how many pixels neither floor nor wall nor object has taken. Empty without
  /// segments.
  std::vector<std::uint32_t> eligible_;
  PlaneSearchPoints sample_;
  /// That of planes that are suggested, with what has been taken since.
  PlaneSearchPoints whole_sample_;
  /// As it was drawn.
  double pixels_per_point_ = 1.0;
};

}  // namespace credo
