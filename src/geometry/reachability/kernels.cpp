#include "geometry/reachability/kernels.hpp"

#include <algorithm>
#include <bit>
#include <limits>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/reachability/kernels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/reachability/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::reachability::HWY_NAMESPACE {

std::size_t first_pixel(TilePixels const& pixels, int width) {
  return static_cast<std::size_t>(pixels.v) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(pixels.u);
}

// Calls visit(i, bits, shift) for each vector of pixels of which any is in the mask: position i in
// the arrays, bits of its lanes, place of the first of them in the mask. Ends where visit is true.
template <typename Visit>
HWY_INLINE void visit_vectors(TilePixels const& pixels, int width, Visit const& visit) {
  std::size_t const lanes = hn::Lanes(Floats());
  std::uint64_t const ones = (std::uint64_t{1} << lanes) - 1;
  std::size_t row = first_pixel(pixels, width);
  for (int shift = 0; shift < kTile * kTile && (pixels.mask >> shift) != 0; shift += kTile) {
    for (int k = 0; k < kTile; k += static_cast<int>(lanes)) {
      std::uint64_t const bits = (pixels.mask >> (shift + k)) & ones;
      if (bits != 0 && visit(row + static_cast<std::size_t>(k), bits, shift + k)) {
        return;
      }
    }
    row += static_cast<std::size_t>(width);
  }
}

Box box_of(std::array<float const*, 3> const& arrays, int width, TilePixels const& pixels) {
  LaneBounds bounds = nothing();
  visit_vectors(pixels, width, [&](std::size_t i, std::uint64_t bits, int) {
    include(load(arrays, i), mask_of(bits), bounds);
    return false;
  });
  return box_over_lanes(bounds);
}

// Squared distance of points to a box, a lower bound of within_reach's squared distance to any
// point in the box: rounding is monotonic and the order of operations is the same.
HWY_INLINE Vec squared_gap(Vec3 const& min, Vec3 const& max, Vec3 const& box_min,
                           Vec3 const& box_max) {
  Vec const zero = hn::Zero(Floats());
  Vec3 const below = difference(box_min, max);
  Vec3 const above = difference(min, box_max);
  Vec3 const gap = {hn::Max(zero, hn::Max(below.x, above.x)),
                    hn::Max(zero, hn::Max(below.y, above.y)),
                    hn::Max(zero, hn::Max(below.z, above.z))};
  return ordered_dot(gap, gap);
}

// Those of the pixels whose point lies within the radius of the box.
HWY_INLINE TilePixels near_box(PointArrays const& points, TilePixels const& pixels, Box const& box,
                               ReachThresholds const& reach) {
  Vec3 const box_min = broadcast(box.min[0], box.min[1], box.min[2]);
  Vec3 const box_max = broadcast(box.max[0], box.max[1], box.max[2]);
  Vec const limit = hn::Set(Floats(), reach.max_squared_distance_m2);
  TilePixels result = pixels;
  result.mask = 0;
  visit_vectors(pixels, points.width, [&](std::size_t i, std::uint64_t bits, int shift) {
    Vec3 const here = load(points.point, i);
    std::uint64_t const near = bits_of(hn::Le(squared_gap(here, here, box_min, box_max), limit));
    result.mask |= (near & bits) << shift;
    return false;
  });
  return result;
}

HWY_INLINE Oriented pixel_of(PointArrays const& points, TilePixels const& tile, int bit) {
  std::size_t const i =
      first_pixel(tile, points.width) +
      static_cast<std::size_t>(bit / kTile) * static_cast<std::size_t>(points.width) +
      static_cast<std::size_t>(bit % kTile);
  return {broadcast(points.point[0][i], points.point[1][i], points.point[2][i]),
          broadcast(points.normal[0][i], points.normal[1][i], points.normal[2][i])};
}

HWY_INLINE bool any_neighbour(PointArrays const& points, Oriented const& one,
                              TilePixels const& many, ReachThresholds const& reach) {
  bool any = false;
  visit_vectors(many, points.width, [&](std::size_t i, std::uint64_t bits, int) {
    any = (bits_of(within_reach(one, load(points, i), reach)) & bits) != 0;
    return any;
  });
  return any;
}

bool any_within_reach(PointArrays const& points, TilePixels const& a, Box const& box_a,
                      TilePixels const& b, Box const& box_b, ReachThresholds const& reach) {
  TilePixels const near_a = near_box(points, a, box_b, reach);
  if (near_a.mask == 0) {
    return false;
  }
  TilePixels const near_b = near_box(points, b, box_a, reach);
  bool const a_is_smaller = std::popcount(near_a.mask) < std::popcount(near_b.mask);
  TilePixels const& few = a_is_smaller ? near_a : near_b;
  TilePixels const& many = a_is_smaller ? near_b : near_a;
  for (std::uint64_t rest = few.mask; rest != 0; rest &= rest - 1) {
    if (any_neighbour(points, pixel_of(points, few, std::countr_zero(rest)), many, reach)) {
      return true;
    }
  }
  return false;
}

TileLinks tile_links(PointArrays const& points, TilePixels const& a, TilePixels const& b,
                     ReachThresholds const& reach) {
  TileLinks links{};
  for (std::uint64_t rest = a.mask; rest != 0; rest &= rest - 1) {
    int const bit = std::countr_zero(rest);
    Oriented const one = pixel_of(points, a, bit);
    std::uint64_t linked = 0;
    visit_vectors(b, points.width, [&](std::size_t i, std::uint64_t bits, int shift) {
      linked |= (bits_of(within_reach(one, load(points, i), reach)) & bits) << shift;
      return false;
    });
    links[static_cast<std::size_t>(bit)] = linked;
  }
  return links;
}

std::uint32_t boxes_in_reach(BoxList const& others, std::size_t i, BoxList const& boxes,
                             std::size_t begin, ReachThresholds const& reach) {
  Floats const d;
  hn::RebindToSigned<Floats> const ints;
  std::size_t const lanes = hn::Lanes(d);
  Vec3 const min = broadcast(others.min[0][i], others.min[1][i], others.min[2][i]);
  Vec3 const max = broadcast(others.max[0][i], others.max[1][i], others.max[2][i]);
  Vec const limit = hn::Set(d, reach.max_squared_distance_m2);
  auto const first = hn::Set(ints, others.first_root[i]);
  auto const last = hn::Set(ints, others.last_root[i]);
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < BoxList::kBoxesAtOnce; k += lanes) {
    std::size_t const at = begin + k;
    Vec3 const box_min = load({boxes.min[0].data(), boxes.min[1].data(), boxes.min[2].data()}, at);
    Vec3 const box_max = load({boxes.max[0].data(), boxes.max[1].data(), boxes.max[2].data()}, at);
    auto const lowest = hn::Min(first, hn::LoadU(ints, boxes.first_root.data() + at));
    auto const highest = hn::Max(last, hn::LoadU(ints, boxes.last_root.data() + at));
    Mask const near = hn::Le(squared_gap(min, max, box_min, box_max), limit);
    Mask const differ = hn::RebindMask(d, hn::Ne(lowest, highest));
    bits |= bits_of(hn::And(near, differ)) << k;
  }
  return static_cast<std::uint32_t>(bits);
}

}  // namespace credo::reachability::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::reachability {

HWY_EXPORT(box_of);
HWY_EXPORT(any_within_reach);
HWY_EXPORT(tile_links);
HWY_EXPORT(boxes_in_reach);

Box box_of(std::array<float const*, 3> const& arrays, int width, TilePixels const& pixels) {
  return HWY_DYNAMIC_DISPATCH(box_of)(arrays, width, pixels);
}

bool any_within_reach(PointArrays const& points, TilePixels const& a, Box const& box_a,
                      TilePixels const& b, Box const& box_b, ReachThresholds const& reach) {
  return HWY_DYNAMIC_DISPATCH(any_within_reach)(points, a, box_a, b, box_b, reach);
}

TileLinks tile_links(PointArrays const& points, TilePixels const& a, TilePixels const& b,
                     ReachThresholds const& reach) {
  return HWY_DYNAMIC_DISPATCH(tile_links)(points, a, b, reach);
}

std::uint32_t boxes_in_reach(BoxList const& others, std::size_t i, BoxList const& boxes,
                             std::size_t begin, ReachThresholds const& reach) {
  return HWY_DYNAMIC_DISPATCH(boxes_in_reach)(others, i, boxes, begin, reach);
}

BoxList::BoxList(std::size_t count)
    : first_root((count + kBoxesAtOnce - 1) / kBoxesAtOnce * kBoxesAtOnce,
                 std::numeric_limits<std::int32_t>::max()),
      last_root(first_root.size(), -1) {
  min.fill(std::vector<float>(first_root.size(), std::numeric_limits<float>::infinity()));
  max.fill(std::vector<float>(first_root.size(), -std::numeric_limits<float>::infinity()));
}

void BoxList::set_box(std::size_t i, Box const& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis][i] = box.min[axis];
    max[axis][i] = box.max[axis];
  }
}

Box BoxList::box(std::size_t i) const {
  return {.min = {min[0][i], min[1][i], min[2][i]}, .max = {max[0][i], max[1][i], max[2][i]}};
}

void BoxList::include(std::size_t i, BoxList const& other, std::size_t j) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis][i] = std::min(min[axis][i], other.min[axis][j]);
    max[axis][i] = std::max(max[axis][i], other.max[axis][j]);
  }
  first_root[i] = std::min(first_root[i], other.first_root[j]);
  last_root[i] = std::max(last_root[i], other.last_root[j]);
}

}  // namespace credo::reachability
#endif
