#include "stages/planes/is_wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stages/planes/wall_strips.hpp"

namespace credo {
namespace {

/// Height from the lowest to the highest of every few pixels, without the outermost per cent at
/// either end.
double vertical_extent_m(PlaneView const& view, PixelPlane const& plane) {
  constexpr std::size_t kEvery = 7;
  Heights const height_m(view);
  std::vector<float> heights;
  heights.reserve(plane.inliers.count / kEvery + 1);
  plane.inliers.pixels.for_every(kEvery, [&](std::size_t i) { heights.push_back(height_m(i)); });
  auto const cut = static_cast<std::ptrdiff_t>(heights.size() / 100);
  auto const top = static_cast<std::ptrdiff_t>(heights.size()) - 1 - cut;
  std::nth_element(heights.begin(), heights.begin() + cut, heights.end());
  float const low_m = heights[static_cast<std::size_t>(cut)];
  std::nth_element(heights.begin(), heights.begin() + top, heights.end());
  return static_cast<double>(heights[static_cast<std::size_t>(top)] - low_m);
}

/// Whether pixels are more than noise puts beyond a wall of this size.
bool are_many(PlaneView const& view, PixelPlane const& plane, std::size_t pixels) {
  PlanesConfig const& config = view.config;
  double const allowed =
      std::max(static_cast<double>(config.wall_max_points_beyond),
               config.wall_max_share_beyond * static_cast<double>(plane.inliers.count));
  return static_cast<double>(pixels) > allowed;
}

/// Thesis 3.2: nearly nothing on one of its sides, whichever.
bool has_nothing_on_a_side(PlaneView const& view, PixelPlane const& plane) {
  auto const many_behind = [&](Plane const& side) {
    return are_many(view, plane, pixels_clear_behind(view, side).count);
  };
  return !many_behind(plane.camera) || !many_behind(plane.camera.flipped());
}

/// Nearly nothing behind it; or else it is long, and what is behind it is seen through openings in
/// it or round the one corner where it ends.
bool closes_the_view(PlaneView const& view, PixelPlane const& plane) {
  // Longer than a person is wide.
  constexpr double kMinLength_m = 0.7;
  constexpr double kMinClosedShare = 0.6;
  constexpr double kMaxBackedShare = 0.2;
  // The camera is at the origin.
  bool const faces_camera = plane.camera.signed_distance_m(Eigen::Vector3d::Zero()) >= 0.0;
  CountedPixels const behind =
      pixels_clear_behind(view, faces_camera ? plane.camera : plane.camera.flipped());
  if (!are_many(view, plane, behind.count)) {
    return true;
  }
  WallStrips const strips = wall_strips(view, plane, behind);
  bool const ends_left = are_many(view, plane, strips.past_left);
  bool const ends_right = are_many(view, plane, strips.past_right);
  auto const strips_seen = static_cast<double>(strips.closed + strips.open);
  return strips.closed_length_m >= kMinLength_m &&
         static_cast<double>(strips.closed) >= kMinClosedShare * strips_seen &&
         !(ends_left && ends_right) &&
         static_cast<double>(strips.backed) <= kMaxBackedShare * static_cast<double>(behind.count);
}

}  // namespace

bool is_wall(PlaneView const& view, PixelPlane const& plane) {
  PlanesConfig const& config = view.config;
  Eigen::Vector3d const n = plane.world.normal.cwiseAbs();
  return n.z() < config.wall_max_normal_z && std::max(n.x(), n.y()) > config.wall_min_normal_xy &&
         plane.inliers.count >= static_cast<std::size_t>(config.wall_min_pixels) &&
         vertical_extent_m(view, plane) >= config.wall_min_extent_m &&
         (config.wall_beyond == WallBeyond::kBehind ? closes_the_view(view, plane)
                                                    : has_nothing_on_a_side(view, plane));
}

}  // namespace credo
