#include "geometry/sight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace credo {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr int kBlocksPerRow = 160;

/// The least depth of each block.
Grid<float> block_minima(Grid<float> const& depth_m, int block_px, int width, int height) {
  Grid<float> least_m(width, height, kNone);
  for (int v = 0; v < height * block_px; ++v) {
    float const* row = depth_m.row(v).data();
    for (float& least : least_m.row(v / block_px)) {
      for (int k = 0; k < block_px; ++k, ++row) {
        least = *row > 0.0F && *row < least ? *row : least;
      }
    }
  }
  return least_m;
}

/// The least of each value and the eight around it.
Grid<float> least_around(Grid<float> const& values) {
  Grid<float> along = values;
  for (int v = 0; v < values.height(); ++v) {
    for (int u = 0; u < values.width(); ++u) {
      float const left = u > 0 ? values[{u - 1, v}] : kNone;
      float const right = u + 1 < values.width() ? values[{u + 1, v}] : kNone;
      along[{u, v}] = std::min({left, values[{u, v}], right});
    }
  }
  Grid<float> least = along;
  for (int v = 0; v < values.height(); ++v) {
    for (int u = 0; u < values.width(); ++u) {
      float const above = v > 0 ? along[{u, v - 1}] : kNone;
      float const below = v + 1 < values.height() ? along[{u, v + 1}] : kNone;
      least[{u, v}] = std::min({above, along[{u, v}], below});
    }
  }
  return least;
}

}  // namespace

Sight sight_of(Grid<float> const& depth_m, LabelMap const& labels,
               CameraIntrinsics const& intrinsics) {
  if (!depth_m.same_size(labels)) {
    throw std::logic_error("sight_of: depth and labels differ in size");
  }
  Sight sight;
  sight.intrinsics = intrinsics;
  sight.block_px = std::max(1, (depth_m.width() + kBlocksPerRow / 2) / kBlocksPerRow);
  int const width = depth_m.width() / sight.block_px;
  int const height = depth_m.height() / sight.block_px;
  sight.depth_m = Grid<float>(width, height);
  sight.labels = LabelMap(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      Pixel const middle = sight.middle_of({u, v});
      float const z_m = depth_m[middle];
      sight.depth_m[{u, v}] = z_m > 0.0F && z_m < kNone ? z_m : 0.0F;
      sight.labels[{u, v}] = labels[middle];
    }
  }
  sight.nearest_m = least_around(block_minima(depth_m, sight.block_px, width, height));
  return sight;
}

NormalMap middle_normals(NormalMap const& normals_camera, Sight const& sight) {
  int const width = sight.depth_m.width();
  int const height = sight.depth_m.height();
  if (normals_camera.width() < width * sight.block_px ||
      normals_camera.height() < height * sight.block_px) {
    throw std::logic_error("middle_normals: normals of a smaller image");
  }
  NormalMap middle(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      middle.set(middle.x.index({u, v}), normals_camera.at(sight.middle_of({u, v})));
    }
  }
  return middle;
}

}  // namespace credo
