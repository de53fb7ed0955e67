#include "detector/search_scene.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace credo {
namespace {

/// Planes are looked for in segments of at least this share of the image,
constexpr float kPlaneImageShare = 0.02F;
/// or of this extent,
constexpr float kPlaneExtent_m = 0.3F;
/// that are so flat, as deviation at 1 m, growing with the square of the range.
constexpr float kPlaneRms_m = 0.006F;
constexpr float kPlaneAngleCosine = 0.85F;
constexpr std::size_t kMaxPlanes = 32;

/// Sums over a segment's points.
struct Moments {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double area_m2 = 0.0;

  void add(Eigen::Vector3f const& point_f, double area) {
    Eigen::Vector3d const point = point_f.cast<double>();
    count += 1.0;
    sum += point;
    squares += point * point.transpose();
    area_m2 += area;
  }
};

/// Mean, main axes and variances along them, rising.
struct Spread {
  Eigen::Vector3d mean;
  Eigen::Matrix3d axes;
  Eigen::Vector3d variances;
};

Spread spread_of(Moments const& moments) {
  Eigen::Vector3d const mean = moments.sum / moments.count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const solver(moments.squares / moments.count -
                                                              mean * mean.transpose());
  return {mean, solver.eigenvectors(), solver.eigenvalues().cwiseMax(0.0)};
}

std::int8_t coded(float component) {
  return static_cast<std::int8_t>(std::lround(component * 127.0F));
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

std::vector<Moments> moments_of(SearchScene const& scene, std::size_t segment_count) {
  std::vector<Moments> moments(segment_count);
  double const pixel_solid_angle = 1.0 / (scene.intrinsics.fx_px * scene.intrinsics.fy_px);
  for (int v = 0; v < scene.pixels.height(); ++v) {
    for (int u = 0; u < scene.pixels.width(); ++u) {
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

SceneSegment segment_of(Moments const& moments) {
  SceneSegment segment;
  segment.pixels = static_cast<int>(moments.count);
  if (segment.pixels > 0) {
    Spread const spread = spread_of(moments);
    segment.centre_m = spread.mean.cast<float>();
    // Of an even strip the deviation is its length over the root of 12.
    segment.extent_m = static_cast<float>(std::sqrt(12.0 * spread.variances[2]));
    segment.area_m2 = static_cast<float>(moments.area_m2);
  }
  return segment;
}

std::vector<ScenePlane> planes_of(SearchScene const& scene, std::vector<Moments> const& moments) {
  std::vector<ScenePlane> planes;
  std::vector<std::size_t> order(moments.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return moments[i].count; });
  double const least_pixels =
      static_cast<double>(kPlaneImageShare) * static_cast<double>(scene.pixels.size());
  for (std::size_t const i : order) {
    SceneSegment const& segment = scene.segments[i];
    if (segment.pixels < 400 || planes.size() == kMaxPlanes) {
      break;
    }
    if (moments[i].count < least_pixels && segment.extent_m < kPlaneExtent_m) {
      continue;
    }
    Spread const spread = spread_of(moments[i]);
    auto const range_m = static_cast<float>(spread.mean.z());
    if (std::sqrt(spread.variances[0]) >
        static_cast<double>(kPlaneRms_m * std::max(1.0F, range_m * range_m))) {
      continue;
    }
    Eigen::Vector3d normal = spread.axes.col(0);
    if (normal.dot(spread.mean) > 0.0) {
      normal = -normal;
    }
    planes.push_back({normal.cast<float>(), static_cast<float>(normal.dot(spread.mean)),
                      segment.extent_m, static_cast<std::uint16_t>(i + 1)});
  }
  return planes;
}

/// A pixel is of the first plane that it lies on: its own segment's, or one that goes on through
/// other segments where it turns the same way.
void mark_planes(SearchScene& scene) {
  for (int v = 0; v < scene.pixels.height(); ++v) {
    for (int u = 0; u < scene.pixels.width(); ++u) {
      ScenePixel& pixel = scene.pixels[{u, v}];
      if (pixel.depth_m <= 0.0F) {
        continue;
      }
      Eigen::Vector3f const point = scene.point_at({u, v});
      float const tolerance_m = 0.005F + 0.003F * pixel.depth_m * pixel.depth_m;
      for (std::size_t i = 0; i < scene.planes.size(); ++i) {
        ScenePlane const& plane = scene.planes[i];
        if (std::abs(plane.normal_camera.dot(point) - plane.offset_m) > tolerance_m) {
          continue;
        }
        bool const own = plane.segment == pixel.segment;
        if (own || !pixel.has_normal() ||
            pixel.normal_camera().dot(plane.normal_camera) > kPlaneAngleCosine) {
          pixel.plane = static_cast<std::uint8_t>(i);
          break;
        }
      }
    }
  }
}

/// Every third pixel of every third row is enough for flat pieces.
constexpr int kFacetStep_px = 3;
constexpr std::size_t kFacetPoints = 25;
constexpr float kFacetShare = 0.08F;

std::vector<Facet> scene_facets(SearchScene const& scene) {
  std::vector<std::vector<OrientedPoint>> of_segments(scene.segments.size());
  for (int v = 0; v < scene.pixels.height(); v += kFacetStep_px) {
    for (int u = 0; u < scene.pixels.width(); u += kFacetStep_px) {
      ScenePixel const& pixel = scene.pixels[{u, v}];
      if (pixel.segment > 0 && pixel.has_normal()) {
        of_segments[pixel.segment - 1U].push_back(
            {scene.point_at({u, v}), pixel.normal_camera().normalized()});
      }
    }
  }
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

}  // namespace

SearchScene prepare_scene(Grid<float> const& depth_m, CameraIntrinsics const& intrinsics,
                          NormalMap const& normals, Segments const& segments) {
  SearchScene scene;
  scene.intrinsics = intrinsics;
  scene.pixels = pixels_of(depth_m, normals, segments);
  std::vector<Moments> const moments = moments_of(scene, segments.pixel_counts.size());
  for (Moments const& of_segment : moments) {
    scene.segments.push_back(segment_of(of_segment));
  }
  scene.planes = planes_of(scene, moments);
  mark_planes(scene);
  scene.facets = scene_facets(scene);
  return scene;
}

}  // namespace credo
