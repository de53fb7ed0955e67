#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid.hpp"
#include "drivers/virtual/seeded.hpp"

namespace credo {

/// The part of an image that a client asked for.
struct ImageView {
  /// The image is mirrored first, and then cut.
  bool mirrored = false;
  int left_px = 0;
  int top_px = 0;
  int width_px = 0;
  int height_px = 0;
};

/// Writes width x height pixels, row by row. The view must lie within the image.
template <typename T>
void copy_view(Grid<T> const& image, ImageView const& view, T* out) {
  for (int v = 0; v < view.height_px; ++v) {
    for (int u = 0; u < view.width_px; ++u) {
      int const seen = view.left_px + u;
      *out++ = image[{view.mirrored ? image.width() - 1 - seen : seen, view.top_px + v}];
    }
  }
}

/// Random bytes, the same for the same seed.
inline void fill_with_garbage(std::uint64_t seed, unsigned char* out, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) {
    out[i] = static_cast<unsigned char>(next_random(seed) >> 56);
  }
}

}  // namespace credo
