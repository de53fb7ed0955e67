#include "geometry/reachability_kernels.hpp"

#include <algorithm>
#include <limits>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/reachability_kernels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::reachability::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most one row of a tile: masks fit a byte, whatever the width of the machine's vectors.
using Floats = hn::CappedTag<float, kTile>;
using Vec = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

struct Vec3 {
  Vec x, y, z;
};

// The same operations, in the same order, as credo::ordered_dot.
HWY_INLINE Vec ordered_dot(Vec3 const& a, Vec3 const& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}

HWY_INLINE Vec3 difference(Vec3 const& a, Vec3 const& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vec3 load(std::array<float const*, 3> const& arrays, std::size_t i) {
  Floats const d;
  return {hn::LoadU(d, arrays[0] + i), hn::LoadU(d, arrays[1] + i), hn::LoadU(d, arrays[2] + i)};
}

struct Oriented {
  Vec3 point, normal;
};

HWY_INLINE Oriented load(PointArrays const& points, std::size_t i) {
  return {load(points.point, i), load(points.normal, i)};
}

// The same as credo::within_reach.
HWY_INLINE Mask within_reach(Oriented const& a, Oriented const& b, ReachThresholds const& reach) {
  Floats const d;
  Vec3 const step = difference(a.point, b.point);
  return hn::And(hn::Le(ordered_dot(step, step), hn::Set(d, reach.max_squared_distance_m2)),
                 hn::Gt(ordered_dot(a.normal, b.normal), hn::Set(d, reach.min_cosine)));
}

HWY_INLINE std::uint64_t bits_of(Mask mask) {
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(Floats(), mask, bytes.data());
  return bytes[0];
}

HWY_INLINE Mask mask_of(std::uint64_t bits) {
  std::array<std::uint8_t, 8> const bytes{static_cast<std::uint8_t>(bits)};
  return hn::LoadMaskBits(Floats(), bytes.data());
}

// x - x is 0 where x is finite, else NaN.
HWY_INLINE Mask finite(Oriented const& a) {
  Vec3 const p = difference(a.point, a.point);
  Vec3 const n = difference(a.normal, a.normal);
  Vec const sum = hn::Add(hn::Add(hn::Add(p.x, p.y), hn::Add(p.z, n.x)), hn::Add(n.y, n.z));
  return hn::Eq(sum, hn::Zero(Floats()));
}

HWY_INLINE Mask active_mask(std::uint8_t const* active) {
  Floats const d;
  hn::Rebind<std::uint8_t, Floats> const bytes;
  hn::RebindToSigned<Floats> const ints;
  auto const values = hn::PromoteTo(ints, hn::LoadU(bytes, active));
  return hn::RebindMask(d, hn::Ne(values, hn::Zero(ints)));
}

HWY_INLINE void put(std::uint64_t* row, std::size_t u, std::uint64_t bits) {
  row[u / 64] |= bits << (u % 64);
  row[u / 64 + 1] |= u % 64 == 0 ? 0 : bits >> (64 - u % 64);
}

class SquaredLengths {
public:
  SquaredLengths() : min_(hn::Set(Floats(), 1.0F)), max_(hn::Set(Floats(), 1.0F)) {}
  void add(Vec3 const& normal, Mask usable) {
    Vec const squared = ordered_dot(normal, normal);
    min_ = hn::Min(min_, hn::IfThenElse(usable, squared, min_));
    max_ = hn::Max(max_, hn::IfThenElse(usable, squared, max_));
  }
  [[nodiscard]] float min() const { return hn::GetLane(hn::MinOfLanes(Floats(), min_)); }
  [[nodiscard]] float max() const { return hn::GetLane(hn::MaxOfLanes(Floats(), max_)); }

private:
  Vec min_;
  Vec max_;
};

// The links between one row and the row above, not yet masked by what is usable.
void link_row(PointArrays const& points, std::uint8_t const* active, int v,
              ReachThresholds const& reach, SquaredLengths& lengths, LinkBits& links) {
  auto const width = static_cast<std::size_t>(points.width);
  std::size_t const lanes = hn::Lanes(Floats());
  std::size_t const row = static_cast<std::size_t>(v) * width;
  // The last step overlaps the one before it; the last column is left to link_last_column.
  std::size_t const last = width - 1 - lanes;
  for (std::size_t u = 0;; u = std::min(u + lanes, last)) {
    Oriented const here = load(points, row + u);
    Oriented const right = load(points, row + u + 1);
    Mask const usable = hn::And(finite(here), active_mask(active + row + u));
    lengths.add(here.normal, usable);
    put(links.usable.row(v), u, bits_of(usable));
    put(links.right.row(v), u, bits_of(within_reach(here, right, reach)));
    if (v > 0) {
      Oriented const above = load(points, row - width + u);
      Oriented const above_right = load(points, row - width + u + 1);
      put(links.up.row(v), u, bits_of(within_reach(here, above, reach)));
      put(links.rising.row(v), u, bits_of(within_reach(here, above_right, reach)));
      put(links.falling.row(v), u, bits_of(within_reach(above, right, reach)));
    }
    if (u == last) {
      return;
    }
  }
}

// The last column has no right neighbour: step one column back and keep the last lane.
void link_last_column(PointArrays const& points, std::uint8_t const* active, int v,
                      ReachThresholds const& reach, SquaredLengths& lengths, LinkBits& links) {
  auto const width = static_cast<std::size_t>(points.width);
  std::size_t const lanes = hn::Lanes(Floats());
  std::size_t const u = width - lanes;
  std::size_t const i = static_cast<std::size_t>(v) * width + u;
  Oriented const here = load(points, i);
  Mask const usable = hn::And(finite(here), active_mask(active + i));
  lengths.add(here.normal, usable);
  put(links.usable.row(v), u, bits_of(usable));
  if (v > 0) {
    put(links.up.row(v), u, bits_of(within_reach(here, load(points, i - width), reach)));
  }
}

LinkBits link_neighbours(PointArrays const& points, std::uint8_t const* active,
                         ReachThresholds const& reach) {
  LinkBits links(points.width, points.height);
  SquaredLengths lengths;
  for (int v = 0; v < points.height; ++v) {
    link_row(points, active, v, reach, lengths, links);
    link_last_column(points, active, v, reach, lengths, links);
  }
  links.min_squared_normal = lengths.min();
  links.max_squared_normal = lengths.max();
  return links;
}

HWY_INLINE Vec3 broadcast(float x, float y, float z) {
  Floats const d;
  return {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
}

HWY_INLINE void include(Vec value, Mask mask, Vec& min, Vec& max) {
  Vec const above_all = hn::Set(Floats(), std::numeric_limits<float>::infinity());
  min = hn::Min(min, hn::IfThenElse(mask, value, above_all));
  max = hn::Max(max, hn::IfThenElse(mask, value, hn::Neg(above_all)));
}

// Bounds of three arrays over a tile, into places `first` to `first + 2`.
HWY_INLINE void bound_axes(std::array<float const*, 3> const& arrays, int width,
                           TilePixels const& pixels, std::size_t first, Bounds& bounds) {
  Floats const d;
  std::size_t const lanes = hn::Lanes(d);
  float const inf = std::numeric_limits<float>::infinity();
  Vec3 min = broadcast(inf, inf, inf);
  Vec3 max = broadcast(-inf, -inf, -inf);
  std::size_t row = static_cast<std::size_t>(pixels.v) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(pixels.u);
  for (std::uint64_t rest = pixels.mask; rest != 0; rest >>= kTile) {
    for (std::size_t i = 0; i < kTile && (rest & 0xFFU) != 0; i += lanes) {
      Mask const mask = mask_of((rest & 0xFFU) >> i);
      Vec3 const value = load(arrays, row + i);
      include(value.x, mask, min.x, max.x);
      include(value.y, mask, min.y, max.y);
      include(value.z, mask, min.z, max.z);
    }
    row += static_cast<std::size_t>(width);
  }
  std::array<Vec, 3> const mins{min.x, min.y, min.z};
  std::array<Vec, 3> const maxs{max.x, max.y, max.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bounds.min[first + axis] = hn::GetLane(hn::MinOfLanes(d, mins[axis]));
    bounds.max[first + axis] = hn::GetLane(hn::MaxOfLanes(d, maxs[axis]));
  }
}

Bounds bounds_of(PointArrays const& points, TilePixels const& pixels) {
  Bounds bounds;
  bound_axes(points.point, points.width, pixels, 0, bounds);
  bound_axes(points.normal, points.width, pixels, 3, bounds);
  return bounds;
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

// Points of a tile, packed; the last vector is filled up with NaN, which is in reach of nothing.
struct PackedPoints {
  static constexpr std::size_t kRoom = kTile * kTile + kTile;
  std::array<std::array<float, kRoom>, 6> values;
  std::size_t count = 0;

  [[nodiscard]] PointArrays arrays() const {
    return {.point = {values[0].data(), values[1].data(), values[2].data()},
            .normal = {values[3].data(), values[4].data(), values[5].data()}};
  }
};

// Those of the pixels whose point lies within the radius of the box.
void pack(PointArrays const& points, TilePixels const& pixels, Bounds const& box,
          ReachThresholds const& reach, PackedPoints& packed) {
  Floats const d;
  std::size_t const lanes = hn::Lanes(d);
  Vec3 const box_min = broadcast(box.min[0], box.min[1], box.min[2]);
  Vec3 const box_max = broadcast(box.max[0], box.max[1], box.max[2]);
  Vec const limit = hn::Set(d, reach.max_squared_distance_m2);
  std::size_t row = static_cast<std::size_t>(pixels.v) * static_cast<std::size_t>(points.width) +
                    static_cast<std::size_t>(pixels.u);
  for (std::uint64_t rest = pixels.mask; rest != 0; rest >>= kTile) {
    for (std::size_t i = 0; i < kTile && (rest & 0xFFU) != 0; i += lanes) {
      Oriented const here = load(points, row + i);
      Mask const near =
          hn::And(mask_of((rest & 0xFFU) >> i),
                  hn::Le(squared_gap(here.point, here.point, box_min, box_max), limit));
      std::array<Vec, 6> const values{here.point.x,  here.point.y,  here.point.z,
                                      here.normal.x, here.normal.y, here.normal.z};
      for (std::size_t axis = 0; axis < 6; ++axis) {
        hn::StoreU(hn::Compress(values[axis], near), d, packed.values[axis].data() + packed.count);
      }
      packed.count += hn::CountTrue(d, near);
    }
    row += static_cast<std::size_t>(points.width);
  }
  for (auto& values : packed.values) {
    hn::StoreU(hn::Set(d, kNaN), d, values.data() + packed.count);
  }
}

bool any_within_reach(PointArrays const& points, TilePixels const& a, Bounds const& bounds_a,
                      TilePixels const& b, Bounds const& bounds_b, ReachThresholds const& reach) {
  PackedPoints packed_a;
  PackedPoints packed_b;
  pack(points, a, bounds_b, reach, packed_a);
  pack(points, b, bounds_a, reach, packed_b);
  bool const a_is_smaller = packed_a.count < packed_b.count;
  PackedPoints const& few = a_is_smaller ? packed_a : packed_b;
  PackedPoints const& many = a_is_smaller ? packed_b : packed_a;
  PointArrays const many_arrays = many.arrays();
  for (std::size_t i = 0; i < few.count; ++i) {
    Oriented const one = {broadcast(few.values[0][i], few.values[1][i], few.values[2][i]),
                          broadcast(few.values[3][i], few.values[4][i], few.values[5][i])};
    for (std::size_t j = 0; j < many.count; j += hn::Lanes(Floats())) {
      if (!hn::AllFalse(Floats(), within_reach(one, load(many_arrays, j), reach))) {
        return true;
      }
    }
  }
  return false;
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

HWY_EXPORT(link_neighbours);
HWY_EXPORT(bounds_of);
HWY_EXPORT(any_within_reach);
HWY_EXPORT(boxes_in_reach);

LinkBits link_neighbours(PointArrays const& points, std::uint8_t const* active,
                         ReachThresholds const& reach) {
  return HWY_DYNAMIC_DISPATCH(link_neighbours)(points, active, reach);
}

Bounds bounds_of(PointArrays const& points, TilePixels const& pixels) {
  return HWY_DYNAMIC_DISPATCH(bounds_of)(points, pixels);
}

bool any_within_reach(PointArrays const& points, TilePixels const& a, Bounds const& bounds_a,
                      TilePixels const& b, Bounds const& bounds_b, ReachThresholds const& reach) {
  return HWY_DYNAMIC_DISPATCH(any_within_reach)(points, a, bounds_a, b, bounds_b, reach);
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

void BoxList::set_bounds(std::size_t i, Bounds const& bounds) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis][i] = bounds.min[axis];
    max[axis][i] = bounds.max[axis];
  }
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
