#include "stages/planes/wall_strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace credo {
namespace {

constexpr std::size_t kStrips = 64;
/// Of all pixels of the picture every so manieth is looked at: primes, so that they divide no width
/// and all columns are.
constexpr std::array<std::size_t, 5> kEvery = {11, 23, 43, 89, 173};
/// A strip with a smaller part of a fair share of the plane's pixels does not show it.
constexpr double kLeastPart = 0.1;

/// For a plane of so many pixels.
std::size_t every_of(std::size_t plane_pixels) {
  std::size_t every = kEvery.front();
  for (std::size_t const more : kEvery) {
    if (plane_pixels >= kEnoughShown * more) {
      every = more;
    }
  }
  return every;
}

std::vector<std::uint32_t> some_of(CountedPixels const& pixels, std::size_t every) {
  std::vector<std::uint32_t> some;
  some.reserve(2 * pixels.count / every);
  // Of each word the first bit that is looked at.
  std::size_t first = 0;
  std::span<std::uint64_t const> const words = pixels.pixels.words();
  for (std::size_t w = 0; w < words.size(); ++w) {
    for (; first < PixelSet::kWordBits; first += every) {
      if (((words[w] >> first) & 1U) != 0) {
        some.push_back(static_cast<std::uint32_t>(w * PixelSet::kWordBits + first));
      }
    }
    first -= PixelSet::kWordBits;
  }
  return some;
}

/// Where pixels are from left to right, however the camera is turned: the tangent of the angle from
/// the camera's heading. Strips of equal tangent are equally wide in a level camera's picture.
class Bearings {
public:
  explicit Bearings(PlaneView const& view) {
    Eigen::Matrix3d const rotation = view.T_world_camera.rotation().toRotationMatrix();
    // A camera that looks straight down is headed where the top of its picture is.
    Eigen::Vector3d ahead = rotation.col(2);
    if (ahead.head<2>().norm() < 0.1) {
      ahead = -rotation.col(1);
    }
    ahead.z() = 0.0;
    ahead.normalize();
    ahead_camera_ = (rotation.transpose() * ahead).cast<float>();
    right_camera_ = (rotation.transpose() * ahead.cross(Eigen::Vector3d::UnitZ())).cast<float>();
  }

  [[nodiscard]] float operator()(Eigen::Vector3f const& p) const {
    constexpr float kLeastAhead_m = 0.01F;
    return right_camera_.dot(p) / std::max(ahead_camera_.dot(p), kLeastAhead_m);
  }

private:
  Eigen::Vector3f ahead_camera_, right_camera_;
};

struct Strip {
  std::size_t shown = 0;
  std::size_t behind = 0;
  std::size_t backed = 0;
  /// Of what is shown, along the plane, level.
  float low_m = std::numeric_limits<float>::infinity();
  float high_m = -std::numeric_limits<float>::infinity();
};

/// From left to right: what lies left of all of the plane, its strips, what lies right of it.
using Strips = std::array<Strip, kStrips + 2>;

Strips counted_strips(PlaneView const& view, PixelPlane const& plane, WallLook const& look) {
  constexpr float kFurnitureDepth_m = 0.8F;
  constexpr float kParallelCosine = 0.9F;
  Bearings const bearing(view);
  auto const& [points_shown, normals_shown, shown] = look.shown;
  auto const& [points_behind, normals_behind, behind] = look.behind;
  std::vector<float> tangents;
  tangents.reserve(shown.size());
  for (std::uint32_t const i : shown) {
    tangents.push_back(bearing(points_shown.at(i)));
  }
  auto const [least, most] =
      tangents.empty() ? std::ranges::min_max_result<float>{} : std::ranges::minmax(tangents);
  // A little less than all strips, so that the rightmost pixels are in the last.
  float const strips_per_tangent =
      (static_cast<float>(kStrips) - 0.01F) / std::max(most - least, 1e-6F);
  Strips strips;
  auto const strip_at = [&, first = least](float tangent) -> Strip& {
    float const place = std::floor((tangent - first) * strips_per_tangent) + 1.0F;
    return strips[static_cast<std::size_t>(
        std::clamp(place, 0.0F, static_cast<float>(kStrips) + 1.0F))];
  };
  Eigen::Vector3f const normal = plane.camera.normal.cast<float>();
  auto const offset_m = static_cast<float>(plane.camera.offset_m);
  Eigen::Vector3d const along_world =
      plane.world.normal.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Vector3f const along =
      (view.T_world_camera.rotation().conjugate() * along_world).cast<float>();
  for (std::size_t k = 0; k < shown.size(); ++k) {
    Strip& strip = strip_at(tangents[k]);
    float const along_m = along.dot(points_shown.at(shown[k]));
    ++strip.shown;
    strip.low_m = std::min(strip.low_m, along_m);
    strip.high_m = std::max(strip.high_m, along_m);
  }
  for (std::uint32_t const i : behind) {
    Eigen::Vector3f const p = points_behind.at(i);
    Strip& strip = strip_at(bearing(p));
    float const depth_m = std::abs(normal.dot(p) - offset_m);
    ++strip.behind;
    // Most lie deeper: their normals need not be fetched.
    if (depth_m <= kFurnitureDepth_m &&
        std::abs(normal.dot(normals_behind.at(i))) >= kParallelCosine) {
      ++strip.backed;
    }
  }
  return strips;
}

}  // namespace

WallLook look_at_wall(PlaneView const& view, PixelPlane const& plane, CountedPixels const& behind) {
  std::size_t const every = every_of(plane.inliers.count);
  VectorColumns const points = VectorColumns::of(view.cloud);
  VectorColumns const normals = VectorColumns::of(view.normals);
  return {{points, normals, some_of(plane.inliers, every)},
          {points, normals, some_of(behind, every)},
          static_cast<double>(every)};
}

WallStrips wall_strips(PlaneView const& view, PixelPlane const& plane, WallLook const& look) {
  Strips const strips = counted_strips(view, plane, look);
  double const fair_share = static_cast<double>(look.shown.positions.size()) / kStrips;
  auto const shows_plane = [&](Strip const& strip) {
    return static_cast<double>(strip.shown) >= kLeastPart * fair_share;
  };
  auto const first = std::ranges::find_if(strips, shows_plane);
  auto const last = std::find_if(strips.rbegin(), strips.rend(), shows_plane).base();
  WallStrips result;
  float low_m = std::numeric_limits<float>::infinity();
  float high_m = -low_m;
  for (auto strip = strips.begin(); strip != strips.end(); ++strip) {
    double const allowed =
        view.config.wall_max_share_beyond * std::max(fair_share, static_cast<double>(strip->shown));
    result.backed += look.pixels_each * static_cast<double>(strip->backed);
    if (strip < first || strip >= last) {
      (strip < first ? result.past_left : result.past_right) +=
          look.pixels_each * static_cast<double>(strip->behind);
    } else if (static_cast<double>(strip->behind) > allowed) {
      ++result.open;
    } else if (shows_plane(*strip)) {
      ++result.closed;
      low_m = std::min(low_m, strip->low_m);
      high_m = std::max(high_m, strip->high_m);
    }
  }
  if (result.closed > 0) {
    result.closed_length_m = static_cast<double>(high_m - low_m) *
                             static_cast<double>(result.closed) / static_cast<double>(last - first);
  }
  return result;
}

}  // namespace credo
