#include "stages/normals/block_image.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/cloud.hpp"

namespace credo::normals {
namespace {

constexpr int kRowsPerTask = 16;
// The farthest sample of a window, plus the blocks that it averages.
constexpr int kMargin = 4 * kMaxTaps + 4;

float const* padded_row(Grid<float> const& depth_m, int v, std::vector<float>& space) {
  std::size_t const padded = 2 * padded_lanes(static_cast<std::size_t>(depth_m.width() + 1) / 2);
  if (v < depth_m.height() && depth_m.row(v).size() == padded) {
    return depth_m.row(v).data();
  }
  space.assign(padded, kNaN);
  if (v < depth_m.height()) {
    std::ranges::copy(depth_m.row(v), space.begin());
  }
  return space.data();
}

}  // namespace

PaddedImage::PaddedImage(int width, int height, int margin)
    : margin_(margin),
      stride_(static_cast<std::ptrdiff_t>(padded_lanes(static_cast<std::size_t>(width))) +
              2 * margin),
      data_(std::make_unique_for_overwrite<float[]>(
          static_cast<std::size_t>(stride_ * (height + 2 * margin)))) {
  // Above, then to the right of one row and left of the next together, then below.
  std::fill(data_.get(), row(0), kNothing);
  for (int v = 0; v < height; ++v) {
    std::fill_n(row(v + 1) - 2 * margin, 2 * margin, kNothing);
  }
  std::fill_n(row(height), stride_ * margin - margin, kNothing);
}

void PaddedImage::end_row(int v, int width) {
  std::fill(row(v) + width, row(v) + stride_ - 2 * margin_, kNothing);
}

LevelRows BlockImage::level_rows(int v) const {
  LevelRows rows;
  for (std::size_t i = 0; i < kLevels; ++i) {
    rows.levels[i] = levels[i].row(v);
  }
  rows.stride = levels[0].stride();
  return rows;
}

PixelRows pixel_rows(Grid<float> const& depth_m, int block_v, PixelRowsSpace& space) {
  return {padded_row(depth_m, 2 * block_v, space[0]),
          padded_row(depth_m, 2 * block_v + 1, space[1])};
}

BlockImage make_block_image(Grid<float> const& depth_m, DepthTolerance tolerance) {
  BlockImage image;
  image.width = (depth_m.width() + 1) / 2;
  image.height = (depth_m.height() + 1) / 2;
  for (PaddedImage& level : image.levels) {
    level = PaddedImage(image.width, image.height, kMargin);
  }
  auto const count = static_cast<std::size_t>(image.width);
  tbb::blocked_range<int> const all_rows(0, image.height, kRowsPerTask);
  tbb::parallel_for(all_rows, [&](auto const& rows) {
    PixelRowsSpace space;
    for (int v = rows.begin(); v < rows.end(); ++v) {
      make_blocks(pixel_rows(depth_m, v, space), count, tolerance, image.levels[0].row(v));
      image.levels[0].end_row(v, image.width);
    }
  });
  for (std::size_t level = 1; level < kLevels; ++level) {
    // Half of the blocks to each side: u - 1 and u, then u - 1 and u + 1.
    int const right = static_cast<int>(level) - 1;
    PaddedImage const& finer = image.levels[level - 1];
    PaddedImage& coarser = image.levels[level];
    tbb::parallel_for(all_rows, [&](auto const& rows) {
      for (int v = rows.begin(); v < rows.end(); ++v) {
        merge_blocks(finer.row(v - 1), finer.row(v + right), -1, right, count, tolerance,
                     coarser.row(v));
        coarser.end_row(v, image.width);
      }
    });
  }
  return image;
}

}  // namespace credo::normals
