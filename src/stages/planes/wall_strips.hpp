#pragma once

#include <cstddef>

#include "stages/planes/plane_view.hpp"

namespace credo {

/// How an upright plane closes the view, told in upright strips of the picture. A strip that shows
/// it is closed where next to nothing is seen behind it there: neither over its top, nor through
/// it, nor below it. So a wall with a door or window in it is closed in most of its strips, and
/// what one looks over (a table's front, a cupboard, a person) or through (a rack) in few or none.
struct WallStrips {
  std::size_t closed = 0;
  /// Strips between the first and the last that show the plane with more behind it than that.
  std::size_t open = 0;
  /// How long the plane is, level, from the first to the last of the closed strips, and of that the
  /// closed strips' part.
  double closed_length_m = 0.0;
  /// Pixels behind the plane that are seen past its ends: a free end is a corner of the wall, or
  /// the side of a thing.
  std::size_t past_left = 0;
  std::size_t past_right = 0;
  /// Of all pixels behind, those that face as the plane does and lie no deeper behind it than
  /// furniture is deep: behind a cupboard or a door is the wall that it stands before; through an
  /// opening or round a corner is another room.
  std::size_t backed = 0;
};

/// `behind` are all pixels clear of the plane on its far side.
[[nodiscard]] WallStrips wall_strips(PlaneView const& view, PixelPlane const& plane,
                                     CountedPixels const& behind);

}  // namespace credo
