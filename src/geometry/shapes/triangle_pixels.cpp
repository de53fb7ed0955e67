#include "geometry/shapes/triangle_pixels.hpp"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/shapes/triangle_pixels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using PixelLanes = hn::CappedTag<float, kTrianglePadding>;
using Pixels = hn::Vec<PixelLanes>;

// A pixel on the edge of two triangles is drawn by one of them at least, whatever is rounded.
constexpr float kOnEdge = -1e-5F;

HWY_INLINE Pixels value_at(AffineInImage const& value, Pixels u, float v) {
  PixelLanes const d;
  return hn::Add(hn::Set(d, value.at_corner + v * value.per_v),
                 hn::Mul(u, hn::Set(d, value.per_u)));
}

// Without branches by pixel: half of a triangle's box is outside, and no processor foresees which.
void draw_pixels(TriangleInImage const& triangle, float* nearest_per_m, std::size_t stride) {
  PixelLanes const d;
  auto const width = static_cast<std::size_t>(triangle.width_px);
  Pixels const end = hn::Set(d, static_cast<float>(triangle.width_px));
  for (int row = 0; row < triangle.height_px; ++row) {
    auto const v = static_cast<float>(row);
    for (std::size_t first = 0; first < width; first += hn::Lanes(d)) {
      Pixels const u = hn::Iota(d, static_cast<float>(first));
      Pixels const least = hn::Min(hn::Min(value_at(triangle.a, u, v), value_at(triangle.b, u, v)),
                                   value_at(triangle.c, u, v));
      auto const inside = hn::And(hn::Ge(least, hn::Set(d, kOnEdge)), hn::Lt(u, end));
      Pixels const here = hn::IfThenElseZero(inside, value_at(triangle.per_m, u, v));
      hn::StoreU(hn::Max(hn::LoadU(d, nearest_per_m + first), here), d, nearest_per_m + first);
    }
    nearest_per_m += stride;
  }
}

}  // namespace credo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo {

HWY_EXPORT(draw_pixels);

void draw_triangle(TriangleInImage const& triangle, float* nearest_per_m, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(draw_pixels)(triangle, nearest_per_m, stride);
}

}  // namespace credo
#endif
