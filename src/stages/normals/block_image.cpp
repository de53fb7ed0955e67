#include "stages/normals/block_image.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/cloud.hpp"

namespace credo::normals {
namespace {

// The farthest sample of a window, plus the blocks that it averages.
constexpr int kMargin = 4 * kMaxTaps + 4;

}  // namespace

PaddedImage::PaddedImage(int width, int height, int margin, float value)
    : margin_(margin),
      stride_(static_cast<std::ptrdiff_t>(padded_lanes(static_cast<std::size_t>(width))) +
              2 * margin),
      data_(static_cast<std::size_t>(stride_ * (height + 2 * margin)), value) {}

LevelRows BlockImage::level_rows(int v) const {
  LevelRows rows;
  for (std::size_t i = 0; i < kLevels; ++i) {
    rows.levels[i] = levels[i].row(v);
  }
  rows.stride = levels[0].stride();
  return rows;
}

void copy_depth_row(Grid<float> const& depth_m, int v, std::vector<float>& out) {
  out.assign(2 * padded_lanes(static_cast<std::size_t>(depth_m.width() + 1) / 2), kNaN);
  if (v < depth_m.height()) {
    std::ranges::copy(depth_m.row(v), out.begin());
  }
}

BlockImage make_block_image(Grid<float> const& depth_m, DepthTolerance tolerance) {
  BlockImage image;
  image.width = (depth_m.width() + 1) / 2;
  image.height = (depth_m.height() + 1) / 2;
  image.levels.fill(PaddedImage(image.width, image.height, kMargin, kNothing));
  image.far_w = PaddedImage(image.width, image.height, 0, kNothing);
  image.near_limit_m = PaddedImage(image.width, image.height, 0, 0.0F);
  image.far_limit_m = image.near_limit_m;
  auto const count = static_cast<std::size_t>(image.width);

  constexpr int kRowsPerTask = 16;
  tbb::parallel_for(tbb::blocked_range<int>(0, image.height, kRowsPerTask), [&](auto const& rows) {
    std::vector<float> top;
    std::vector<float> bottom;
    for (int v = rows.begin(); v < rows.end(); ++v) {
      copy_depth_row(depth_m, 2 * v, top);
      copy_depth_row(depth_m, 2 * v + 1, bottom);
      make_blocks(top.data(), bottom.data(), count, tolerance, image.row(v));
    }
  });
  for (std::size_t level = 1; level < kLevels; ++level) {
    // Half of the blocks to each side: u - 1 and u, then u - 1 and u + 1.
    int const right = static_cast<int>(level) - 1;
    PaddedImage const& finer = image.levels[level - 1];
    PaddedImage& coarser = image.levels[level];
    tbb::parallel_for(
        tbb::blocked_range<int>(0, image.height, kRowsPerTask), [&](auto const& rows) {
          for (int v = rows.begin(); v < rows.end(); ++v) {
            merge_blocks(finer.row(v - 1), finer.row(v + right), -1, right, count, tolerance,
                         coarser.row(v));
            // Windows end where the image ends, however far the last vector reached.
            std::fill(coarser.row(v) + count, coarser.row(v) + padded_lanes(count), kNothing);
          }
        });
  }
  return image;
}

}  // namespace credo::normals
