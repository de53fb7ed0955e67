#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// A kernel, compiled once per instruction set and chosen at run time.

namespace credo::segments {

/// Over pixels of a disc, from its centre, and their disparities d. Whole numbers, so that no order
/// of adding matters.
struct DiscSums {
  std::int64_t n = 0;
  std::int64_t u = 0;
  std::int64_t v = 0;
  std::int64_t d = 0;
  std::int64_t uu = 0;
  std::int64_t uv = 0;
  std::int64_t vv = 0;
  std::int64_t ud = 0;
  std::int64_t vd = 0;
  std::int64_t dd = 0;

  friend bool operator==(DiscSums const&, DiscSums const&) = default;
};

/// Every second pixel of a row of a disc, from its centre.
struct DiscRow {
  int v = 0;
  int first_u = 0;
  int last_u = 0;
};

/// Where a disc's centre is in two images of one stride.
struct DiscCentre {
  std::int32_t const* label = nullptr;
  std::int16_t const* disparity = nullptr;
  std::ptrdiff_t stride = 0;
};

struct TwoSums {
  DiscSums a;
  DiscSums b;
};

/// Of two labels the pixels in some rows of a disc of at most kMaxDisc_px. Disparities are from 0
/// to 32000; up to 32 pixels behind a row's last are read.
[[nodiscard]] TwoSums disc_sums(DiscCentre const& centre, std::span<DiscRow const> rows,
                                std::int32_t label_a, std::int32_t label_b);

}  // namespace credo::segments
