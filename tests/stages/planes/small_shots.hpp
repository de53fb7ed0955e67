#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/segments.hpp"
#include "stages/planes/pixel_set.hpp"
#include "stages/planes/plane_view.hpp"
#include "stages/planes/planes.hpp"
#include "support/world_scene.hpp"

namespace credo::test {

/// The pictures of the tests have a quarter of the pixels that the default is made for.
inline PlanesConfig small_planes() {
  PlanesConfig config;
  config.min_plane_pixels = 400;
  config.wall_min_pixels = 1000;
  return config;
}

/// The pixels of an image of so many that pass.
template <typename Test>
CountedPixels pixels_where(std::size_t pixels, Test const& test) {
  CountedPixels result{PixelSet(pixels), 0};
  for (std::size_t i = 0; i < pixels; ++i) {
    if (test(i)) {
      result.insert(i);
    }
  }
  return result;
}

/// Of a whole shot, which outlives it as do the segments and settings.
inline PlaneView plane_view_of(Shot const& shot, Segments const& segments,
                               PlanesConfig const& config, bool floor_at_zero = true) {
  OrganizedCloud const& cloud = shot.frame.cloud_camera;
  return {cloud,
          shot.normals,
          shot.T_world_camera,
          floor_at_zero,
          static_cast<float>(shot.frame.intrinsics.fx_px),
          config,
          {0.015F, 4.0F, std::cos(0.35F)},
          PixelBoxes(cloud),
          SegmentPieces(segments),
          pixels_where(cloud.size(), [&](std::size_t i) { return cloud.valid(i); })};
}

/// World position of a pixel.
inline Eigen::Vector3d position_m(Shot const& shot, std::size_t i) {
  return shot.T_world_camera * shot.frame.cloud_camera.at(i).cast<double>();
}

/// The segment, from 1 to 8, that a world position belongs to.
using SegmentOf = std::function<std::int32_t(Eigen::Vector3d const&)>;

inline Segments segments_of(Shot const& shot, SegmentOf const& segment_of) {
  OrganizedCloud const& cloud = shot.frame.cloud_camera;
  Segments segments{
      Grid<std::int32_t>(cloud.width(), cloud.height()), std::vector<std::uint32_t>(8, 0), {}};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.valid(i)) {
      segments.labels[i] = segment_of(position_m(shot, i));
      ++segments.pixel_counts[static_cast<std::size_t>(segments.labels[i] - 1)];
    }
  }
  return segments;
}

}  // namespace credo::test
