#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stages/planes/plane_view.hpp"

namespace credo {

/// Some of an image's points or of a sample's, in raster order.
struct LookedAt {
  VectorColumns points;
  VectorColumns normals;
  std::vector<std::uint32_t> positions;
};

/// An upright plane as far as it is looked at: evenly spread pixels of it, and as many of all that
/// are clear of it on its far side.
struct WallLook {
  LookedAt shown;
  LookedAt behind;
  /// How many pixels each stands for.
  double pixels_each = 1.0;
};

/// Of the pixels that are shown, so many tell of the whole plane.
inline constexpr std::size_t kEnoughShown = 320;

/// Every so manieth pixel: the larger the plane, the fewer of them tell as much.
[[nodiscard]] WallLook look_at_wall(PlaneView const& view, PixelPlane const& plane,
                                    CountedPixels const& behind);

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
  double past_left = 0.0;
  double past_right = 0.0;
  /// Of all pixels behind, those that face as the plane does and lie no deeper behind it than
  /// furniture is deep: behind a cupboard or a door is the wall that it stands before; through an
  /// opening or round a corner is another room.
  double backed = 0.0;
};

/// The pixels of `plane` itself are not looked at.
[[nodiscard]] WallStrips wall_strips(PlaneView const& view, PixelPlane const& plane,
                                     WallLook const& look);

}  // namespace credo
