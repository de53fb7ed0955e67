#include "detector/scenes/search_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "detector/scenes/point_moments.hpp"
#include "detector/scenes/scene_planes.hpp"

namespace credo {
namespace {

std::int8_t coded(float component) {
  return static_cast<std::int8_t>(component * 127.0F + (component < 0.0F ? -0.5F : 0.5F));
}

Grid<ScenePixel> pixels_of(Grid<float> const& depth_m, NormalMap const& normals,
                           Segments const& segments) {
  Grid<ScenePixel> pixels(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    ScenePixel& pixel = pixels[i];
    if (depth_m[i] > 0.0F && std::isfinite(depth_m[i])) {
      pixel.depth_m = depth_m[i];
    }
    if (pixel.depth_m > 0.0F && normals.valid(i)) {
      pixel.normal = {coded(normals.x[i]), coded(normals.y[i]), coded(normals.z[i])};
    }
    if (!segments.labels.empty() && segments.labels[i] < 65536) {
      pixel.segment = static_cast<std::uint16_t>(segments.labels[i]);
    }
  }
  return pixels;
}

std::vector<int> pixels_of_segments(SearchScene const& scene, std::size_t segment_count) {
  std::vector<int> pixels(segment_count, 0);
  for (ScenePixel const& pixel : scene.pixels) {
    if (pixel.segment > 0 && pixel.depth_m > 0.0F) {
      ++pixels[pixel.segment - 1U];
    }
  }
  return pixels;
}

/// Every second pixel of every second row tells how large a segment is.
std::vector<PointMoments> moments_of(SearchScene const& scene, std::size_t segment_count) {
  constexpr int kStep_px = 2;
  std::vector<PointMoments> moments(segment_count);
  double const pixel_solid_angle =
      kStep_px * kStep_px / (scene.intrinsics.fx_px * scene.intrinsics.fy_px);
  for (int v = 0; v < scene.pixels.height(); v += kStep_px) {
    for (int u = 0; u < scene.pixels.width(); u += kStep_px) {
      ScenePixel const& pixel = scene.pixels[{u, v}];
      if (pixel.segment == 0 || pixel.depth_m <= 0.0F) {
        continue;
      }
      Eigen::Vector3f const point = scene.point_at({u, v});
      // A surface seen at a slant is larger than its picture; up to a limit, past which normals
      // are poor.
      float const incidence =
          pixel.has_normal() ? std::abs(pixel.normal_camera().dot(point.normalized())) : 1.0F;
      double const depth_m = static_cast<double>(pixel.depth_m);
      moments[pixel.segment - 1U].add(point, depth_m * depth_m * pixel_solid_angle /
                                                 static_cast<double>(std::max(incidence, 0.2F)));
    }
  }
  return moments;
}

SceneSegment segment_of(PointMoments const& moments, int pixels) {
  SceneSegment segment;
  segment.pixels = pixels;
  if (moments.count > 0.0) {
    PointSpread const spread = spread_of(moments);
    segment.centre_m = spread.mean.cast<float>();
    // Of an even strip the deviation is its length over the root of 12.
    segment.extent_m = static_cast<float>(std::sqrt(12.0 * spread.variances[2]));
    segment.area_m2 = static_cast<float>(moments.area_m2);
  }
  return segment;
}

constexpr std::size_t kFacetPoints = 25;
constexpr float kFacetShare = 0.08F;

std::vector<Facet> scene_facets(SearchScene const& scene) {
  SegmentPoints of_segments = points_of_segments(scene, scene.segments.size());
  std::vector<Facet> facets;
  for (std::size_t i = 0; i < of_segments.size(); ++i) {
    float const tolerance_m = depth_tolerance_m(scene.segments[i].centre_m.z());
    for (Facet& facet :
         facets_of(std::move(of_segments[i]), tolerance_m, kFacetShare, kFacetPoints)) {
      facet.segment = static_cast<std::uint16_t>(i + 1);
      facets.push_back(facet);
    }
  }
  return facets;
}

void find_planes(SearchScene& scene, std::size_t segment_count) {
  scene.planes = large_planes(points_of_segments(scene, segment_count), scene.pixels.size());
  mark_planes(scene);
}

}  // namespace

SearchScene prepare_scene(Grid<float> const& depth_m, CameraIntrinsics const& intrinsics,
                          NormalMap const& normals, Segments const& segments) {
  SearchScene scene;
  scene.intrinsics = intrinsics;
  scene.pixels = pixels_of(depth_m, normals, segments);
  std::size_t segment_count = segments.pixel_counts.size();
  find_planes(scene, segment_count);
  std::size_t const split_count = split_from_planes(scene, segment_count);
  if (split_count > segment_count) {
    // What was split off may be a plane itself, such as a desk's front.
    segment_count = split_count;
    find_planes(scene, segment_count);
  }
  scene.segments.reserve(segment_count);
  std::vector<PointMoments> const moments = moments_of(scene, segment_count);
  std::vector<int> const pixels = pixels_of_segments(scene, segment_count);
  for (std::size_t i = 0; i < segment_count; ++i) {
    scene.segments.push_back(segment_of(moments[i], pixels[i]));
  }
  scene.facets = scene_facets(scene);
  return scene;
}

}  // namespace credo
