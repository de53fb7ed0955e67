#include "stages/planes/is_wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stages/planes/wall_strips.hpp"

namespace credo {
namespace {

/// Height from the lowest to the highest of some points, without the outermost per cent at either
/// end.
double vertical_extent_m(Heights const& height_m, std::vector<std::uint32_t> const& positions) {
  std::vector<float> heights(positions.size());
  std::ranges::transform(positions, heights.begin(), height_m);
  auto const cut = static_cast<std::ptrdiff_t>(heights.size() / 100);
  auto const top = static_cast<std::ptrdiff_t>(heights.size()) - 1 - cut;
  std::nth_element(heights.begin(), heights.begin() + cut, heights.end());
  float const low_m = heights[static_cast<std::size_t>(cut)];
  std::nth_element(heights.begin(), heights.begin() + top, heights.end());
  return static_cast<double>(heights[static_cast<std::size_t>(top)] - low_m);
}

/// A thousand or two, or all of fewer.
std::vector<std::uint32_t> spread_pixels(CountedPixels const& pixels) {
  constexpr std::size_t kLeast = 1000;
  std::size_t const every = std::max<std::size_t>(pixels.count / kLeast, 1);
  std::vector<std::uint32_t> some;
  some.reserve(pixels.count / every + 1);
  pixels.pixels.for_every(every,
                          [&](std::size_t i) { some.push_back(static_cast<std::uint32_t>(i)); });
  return some;
}

/// What is asked of a wall that so many pixels show.
struct Demands {
  PlanesConfig const& config;
  double plane_pixels;
  /// All limits are so many times as wide.
  double leniency = 1.0;

  /// Whether pixels are more than noise puts beyond a wall of this size.
  [[nodiscard]] bool are_many(double pixels) const {
    return pixels > leniency * std::max(static_cast<double>(config.wall_max_points_beyond),
                                        config.wall_max_share_beyond * plane_pixels);
  }
};

/// Thesis 3.2: nearly nothing on one of its sides, whichever.
bool has_nothing_on_a_side(PlaneView const& view, PixelPlane const& plane) {
  Demands const demands{view.config, static_cast<double>(plane.inliers.count)};
  auto const many_behind = [&](Plane const& side) {
    return demands.are_many(static_cast<double>(pixels_clear_behind(view, side).count));
  };
  return !many_behind(plane.camera) || !many_behind(plane.camera.flipped());
}

/// The normal towards the camera, which is at the origin.
Plane facing_camera(Plane const& plane_camera) {
  return plane_camera.signed_distance_m(Eigen::Vector3d::Zero()) >= 0.0 ? plane_camera
                                                                        : plane_camera.flipped();
}

/// Nearly nothing behind it; or else it is long, and what is behind it is seen through openings in
/// it or round the one corner where it ends.
template <typename Look>
bool closes_the_view(PlaneView const& view, PixelPlane const& plane, double pixels_behind,
                     Demands const& demands, Look const& look) {
  // Longer than a person is wide.
  constexpr double kMinLength_m = 0.7;
  constexpr double kMinClosedShare = 0.6;
  constexpr double kMaxBackedShare = 0.2;
  if (!demands.are_many(pixels_behind)) {
    return true;
  }
  WallStrips const strips = wall_strips(view, plane, look());
  auto const strips_seen = static_cast<double>(strips.closed + strips.open);
  return demands.leniency * strips.closed_length_m >= kMinLength_m &&
         demands.leniency * static_cast<double>(strips.closed) >= kMinClosedShare * strips_seen &&
         !(demands.are_many(strips.past_left) && demands.are_many(strips.past_right)) &&
         strips.backed <= demands.leniency * kMaxBackedShare * pixels_behind;
}

bool closes_the_view(PlaneView const& view, PixelPlane const& plane) {
  CountedPixels const behind = pixels_clear_behind(view, facing_camera(plane.camera));
  return closes_the_view(view, plane, static_cast<double>(behind.count),
                         {view.config, static_cast<double>(plane.inliers.count)},
                         [&] { return look_at_wall(view, plane, behind); });
}

/// The positions in a sample of what lies clear of a plane on the side that its normal does not
/// point to.
std::vector<std::uint32_t> sample_behind(Plane const& plane, PlaneSearchPoints const& sample) {
  Eigen::Vector3f const n = plane.normal.cast<float>();
  auto const offset_m = static_cast<float>(plane.offset_m);
  std::vector<std::uint32_t> behind(sample.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    float const distance_m =
        n.x() * sample.x[i] + n.y() * sample.y[i] + n.z() * sample.z[i] - offset_m;
    // Without a branch: which are is not to be foreseen.
    behind[count] = static_cast<std::uint32_t>(i);
    count += distance_m < -sample.tolerance_m[i] ? 1 : 0;
  }
  behind.resize(count);
  return behind;
}

VectorColumns columns(std::vector<float> const& x, std::vector<float> const& y,
                      std::vector<float> const& z) {
  return {x.data(), y.data(), z.data()};
}

}  // namespace

bool is_wall(PlaneView const& view, PixelPlane const& plane) {
  PlanesConfig const& config = view.config;
  Eigen::Vector3d const n = plane.world.normal.cwiseAbs();
  return n.z() < config.wall_max_normal_z && std::max(n.x(), n.y()) > config.wall_min_normal_xy &&
         plane.inliers.count >= static_cast<std::size_t>(config.wall_min_pixels) &&
         vertical_extent_m(Heights(view), spread_pixels(plane.inliers)) >=
             config.wall_min_extent_m &&
         (config.wall_beyond == WallBeyond::kBehind ? closes_the_view(view, plane)
                                                    : has_nothing_on_a_side(view, plane));
}

bool may_be_wall(PlaneView const& view, PixelPlane const& plane, std::vector<std::uint32_t> shown,
                 PlaneSearchPoints const& left, PlaneSearchPoints const& all, double pixels_each) {
  // A few hundred points scatter.
  constexpr double kLeniency = 1.5;
  if (view.config.wall_beyond != WallBeyond::kBehind || shown.size() < kEnoughShown) {
    return true;
  }
  VectorColumns const points_left = columns(left.x, left.y, left.z);
  if (kLeniency * vertical_extent_m(Heights(view, points_left), shown) <
      view.config.wall_min_extent_m) {
    return false;
  }
  Demands const demands{view.config, pixels_each * static_cast<double>(shown.size()), kLeniency};
  WallLook const look{
      {points_left, columns(left.normal_x, left.normal_y, left.normal_z), std::move(shown)},
      {columns(all.x, all.y, all.z), columns(all.normal_x, all.normal_y, all.normal_z),
       sample_behind(facing_camera(plane.camera), all)},
      pixels_each};
  return closes_the_view(view, plane,
                         pixels_each * static_cast<double>(look.behind.positions.size()), demands,
                         [&]() -> WallLook const& { return look; });
}

}  // namespace credo
