#include "stages/planes/wall_strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace credo {
namespace {

constexpr std::size_t kStrips = 64;
/// Of all pixels of the picture every so manieth is looked at: no divisor of usual widths, so that
/// all columns are.
constexpr std::size_t kEvery = 11;
/// A strip with a smaller part of a fair share of the plane's pixels does not show it.
constexpr double kLeastPart = 0.1;

PixelSet some_of(CountedPixels const& pixels) {
  PixelSet some = pixels.pixels;
  // Of each word the first bit that is looked at.
  std::size_t first = 0;
  for (std::uint64_t& word : some.words()) {
    std::uint64_t looked_at = 0;
    for (; first < PixelSet::kWordBits; first += kEvery) {
      looked_at |= std::uint64_t{1} << first;
    }
    first -= PixelSet::kWordBits;
    word &= looked_at;
  }
  return some;
}

/// Where pixels are from left to right, however the camera is turned: the tangent of the angle from
/// the camera's heading. Strips of equal tangent are equally wide in a level camera's picture.
class Bearings {
public:
  explicit Bearings(PlaneView const& view) : cloud_(view.cloud) {
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

  [[nodiscard]] float operator()(std::size_t pixel) const {
    constexpr float kLeastAhead_m = 0.01F;
    Eigen::Vector3f const p = cloud_.at(pixel);
    return right_camera_.dot(p) / std::max(ahead_camera_.dot(p), kLeastAhead_m);
  }

private:
  OrganizedCloud const& cloud_;
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

Strips counted_strips(PlaneView const& view, PixelPlane const& plane, CountedPixels const& behind) {
  constexpr float kFurnitureDepth_m = 0.8F;
  constexpr float kParallelCosine = 0.9F;
  PixelSet const some_inliers = some_of(plane.inliers);
  Bearings const bearing(view);
  float least = std::numeric_limits<float>::infinity();
  float most = -least;
  some_inliers.for_each([&](std::size_t i) {
    float const tangent = bearing(i);
    least = std::min(least, tangent);
    most = std::max(most, tangent);
  });
  // A little less than all strips, so that the rightmost pixels are in the last.
  float const strips_per_tangent =
      (static_cast<float>(kStrips) - 0.01F) / std::max(most - least, 1e-6F);
  Strips strips;
  auto const strip_of = [&](std::size_t i) -> Strip& {
    float const place = std::floor((bearing(i) - least) * strips_per_tangent) + 1.0F;
    return strips[static_cast<std::size_t>(
        std::clamp(place, 0.0F, static_cast<float>(kStrips) + 1.0F))];
  };
  Eigen::Vector3f const normal = plane.camera.normal.cast<float>();
  auto const offset_m = static_cast<float>(plane.camera.offset_m);
  Eigen::Vector3d const along_world =
      plane.world.normal.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Vector3f const along =
      (view.T_world_camera.rotation().conjugate() * along_world).cast<float>();
  some_inliers.for_each([&](std::size_t i) {
    Strip& strip = strip_of(i);
    float const along_m = along.dot(view.cloud.at(i));
    ++strip.shown;
    strip.low_m = std::min(strip.low_m, along_m);
    strip.high_m = std::max(strip.high_m, along_m);
  });
  some_of(behind).for_each([&](std::size_t i) {
    Strip& strip = strip_of(i);
    float const depth_m = std::abs(normal.dot(view.cloud.at(i)) - offset_m);
    ++strip.behind;
    // Most lie deeper: their normals need not be fetched.
    if (depth_m <= kFurnitureDepth_m &&
        std::abs(normal.dot(view.normals.at(i))) >= kParallelCosine) {
      ++strip.backed;
    }
  });
  return strips;
}

}  // namespace

WallStrips wall_strips(PlaneView const& view, PixelPlane const& plane,
                       CountedPixels const& behind) {
  Strips const strips = counted_strips(view, plane, behind);
  double const fair_share = static_cast<double>(plane.inliers.count) / (kStrips * kEvery);
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
    result.backed += kEvery * strip->backed;
    if (strip < first || strip >= last) {
      (strip < first ? result.past_left : result.past_right) += kEvery * strip->behind;
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
