#include "detector/scenes/scene_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "detector/scenes/point_moments.hpp"

namespace credo {
namespace {

constexpr int kStep_px = 3;
/// Planes are looked for in segments of at least this share of the image,
constexpr double kImageShare = 0.02;
/// or of this extent, and never in one of fewer pixels.
constexpr float kLeastExtent_m = 0.3F;
constexpr std::size_t kLeastPixels = 400;
/// Of a segment's points, so many lie on its plane: fewer of a cylinder as large do.
constexpr double kLeastShare = 0.6;
/// Normals of a plane's points, at the least.
constexpr float kSameCosine = 0.85F;
constexpr int kFits = 8;
constexpr std::size_t kMaxPlanes = 32;

float tolerance_m(float depth_m) {
  return 0.005F + 0.003F * depth_m * depth_m;
}

/// A segment as flat as that in all is a plane whatever its normals, which are poor at a slant;
/// as deviation at 1 m, growing with the square of the range.
constexpr double kFlat_m = 0.006;

struct Flat {
  ScenePlane plane;
  double share = 0.0;
  double deviation_m = 0.0;
  double range_m = 0.0;
};

/// By least squares of those points for which `is_in` is true; none of fewer than three.
template <typename IsIn>
std::optional<Flat> fitted(std::vector<OrientedPoint> const& points, IsIn const& is_in) {
  PointMoments moments;
  for (OrientedPoint const& p : points) {
    if (is_in(p)) {
      moments.add(p.point, 0.0);
    }
  }
  if (moments.count < 3.0) {
    return std::nullopt;
  }
  PointSpread const spread = spread_of(moments);
  Eigen::Vector3d normal = spread.axes.col(0);
  if (normal.dot(spread.mean) > 0.0) {
    normal = -normal;
  }
  Flat flat;
  flat.plane.normal_camera = normal.cast<float>();
  flat.plane.offset_m = static_cast<float>(normal.dot(spread.mean));
  // Of an even strip the deviation is its length over the root of 12.
  flat.plane.extent_m = static_cast<float>(std::sqrt(12.0 * spread.variances[2]));
  flat.share = moments.count / static_cast<double>(points.size());
  flat.deviation_m = std::sqrt(spread.variances[0]);
  flat.range_m = spread.mean.z();
  return flat;
}

float distance_m(ScenePlane const& plane, Eigen::Vector3f const& point) {
  return std::abs(plane.normal_camera.dot(point) - plane.offset_m);
}

/// From the plane of all points, to that of those that lie nearer and nearer.
std::optional<Flat> plane_of(std::vector<OrientedPoint> const& points) {
  auto flat = fitted(points, [](OrientedPoint const&) { return true; });
  if (!flat || flat->plane.extent_m < kLeastExtent_m / 3.0F) {
    return std::nullopt;
  }
  if (flat->deviation_m <= kFlat_m * std::max(1.0, flat->range_m * flat->range_m)) {
    return flat;
  }
  float reach_m = flat->plane.extent_m;
  for (int i = 0; i < kFits && flat; ++i) {
    reach_m *= 0.4F;
    ScenePlane const plane = flat->plane;
    flat = fitted(points, [&](OrientedPoint const& p) {
      return distance_m(plane, p.point) < std::max(reach_m, tolerance_m(p.point.z())) &&
             (i < 2 || p.normal.dot(plane.normal_camera) > kSameCosine);
    });
  }
  return flat && flat->share >= kLeastShare ? flat : std::nullopt;
}

/// Whether a pixel is of a plane's segment and stands off the plane.
bool stands_off(ScenePixel const& pixel, std::vector<bool> const& of_plane) {
  return pixel.segment > 0 && pixel.depth_m > 0.0F && pixel.plane == kNoPlane &&
         of_plane[pixel.segment - 1U];
}

/// Connected pixels that stand off, from `first` on; they are marked as seen.
std::vector<std::size_t> connected(SearchScene const& scene, std::vector<bool> const& of_plane,
                                   std::size_t first, Grid<std::uint8_t>& seen) {
  constexpr std::array<Pixel, 4> kSides = {Pixel{-1, 0}, Pixel{1, 0}, Pixel{0, -1}, Pixel{0, 1}};
  constexpr float kSameThing_m = 0.02F;
  std::vector<std::size_t> found = {first};
  seen[first] = 1;
  auto const width = static_cast<std::size_t>(scene.pixels.width());
  for (std::size_t next = 0; next < found.size(); ++next) {
    Pixel const at{static_cast<int>(found[next] % width), static_cast<int>(found[next] / width)};
    ScenePixel const& here = scene.pixels[at];
    for (Pixel const& side : kSides) {
      Pixel const there{at.u + side.u, at.v + side.v};
      if (!scene.pixels.contains(there) || seen[there] != 0) {
        continue;
      }
      ScenePixel const& other = scene.pixels[there];
      if (stands_off(other, of_plane) && other.segment == here.segment &&
          std::abs(other.depth_m - here.depth_m) < kSameThing_m) {
        seen[there] = 1;
        found.push_back(scene.pixels.index(there));
      }
    }
  }
  return found;
}

}  // namespace

SegmentPoints points_of_segments(SearchScene const& scene, std::size_t segment_count) {
  SegmentPoints points(segment_count);
  for (int v = 0; v < scene.pixels.height(); v += kStep_px) {
    for (int u = 0; u < scene.pixels.width(); u += kStep_px) {
      ScenePixel const& pixel = scene.pixels[{u, v}];
      if (pixel.segment > 0 && pixel.has_normal() && pixel.depth_m > 0.0F) {
        points[pixel.segment - 1U].push_back(
            {scene.point_at({u, v}), pixel.normal_camera().normalized()});
      }
    }
  }
  return points;
}

std::vector<ScenePlane> large_planes(SegmentPoints const& points, std::size_t image_pixels) {
  constexpr std::size_t kPixelsOfPoint = kStep_px * kStep_px;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return points[i].size(); });
  auto const large = static_cast<std::size_t>(kImageShare * static_cast<double>(image_pixels));
  std::vector<ScenePlane> planes;
  for (std::size_t const i : order) {
    std::size_t const pixels = kPixelsOfPoint * points[i].size();
    if (pixels < kLeastPixels || planes.size() == kMaxPlanes) {
      break;
    }
    auto flat = plane_of(points[i]);
    if (flat && (pixels >= large || flat->plane.extent_m >= kLeastExtent_m)) {
      flat->plane.segment = static_cast<std::uint16_t>(i + 1);
      planes.push_back(flat->plane);
    }
  }
  return planes;
}

void mark_planes(SearchScene& scene) {
  for (int v = 0; v < scene.pixels.height(); ++v) {
    for (int u = 0; u < scene.pixels.width(); ++u) {
      ScenePixel& pixel = scene.pixels[{u, v}];
      pixel.plane = kNoPlane;
      if (pixel.depth_m <= 0.0F) {
        continue;
      }
      Eigen::Vector3f const point = scene.point_at({u, v});
      for (std::size_t i = 0; i < scene.planes.size(); ++i) {
        ScenePlane const& plane = scene.planes[i];
        if (distance_m(plane, point) > tolerance_m(pixel.depth_m)) {
          continue;
        }
        bool const own = plane.segment == pixel.segment;
        if (own || !pixel.has_normal() ||
            pixel.normal_camera().dot(plane.normal_camera) > kSameCosine) {
          pixel.plane = static_cast<std::uint8_t>(i);
          break;
        }
      }
    }
  }
}

std::size_t split_from_planes(SearchScene& scene, std::size_t segment_count) {
  constexpr std::size_t kLeast_px = 60;
  std::vector<bool> of_plane(segment_count, false);
  for (ScenePlane const& plane : scene.planes) {
    of_plane[plane.segment - 1U] = true;
  }
  Grid<std::uint8_t> seen(scene.pixels.width(), scene.pixels.height(), 0);
  std::size_t count = segment_count;
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    if (seen[i] != 0 || !stands_off(scene.pixels[i], of_plane)) {
      continue;
    }
    std::vector<std::size_t> const thing = connected(scene, of_plane, i, seen);
    if (thing.size() < kLeast_px || count == std::numeric_limits<std::uint16_t>::max()) {
      continue;
    }
    ++count;
    // A new segment's number is beyond of_plane, but its pixels are all seen by now.
    for (std::size_t const pixel : thing) {
      scene.pixels[pixel].segment = static_cast<std::uint16_t>(count);
    }
  }
  return count;
}

}  // namespace credo
