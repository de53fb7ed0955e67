#include "stages/segments/convexity/kernels.hpp"

#include <bit>
#include <type_traits>

#include "stages/segments/convexity/limits.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "stages/segments/convexity/kernels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "geometry/mask_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::segments::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using lanes::HWY_NAMESPACE::add_where;
using lanes::HWY_NAMESPACE::max_where;
using lanes::HWY_NAMESPACE::store_bits;

// At most the 64 columns of a row's margin.
using D16 = hn::CappedTag<std::int16_t, 32>;
using V16 = hn::Vec<D16>;
using M16 = hn::Mask<D16>;
using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using D8 = hn::CappedTag<std::uint8_t, 64>;

HWY_INLINE V16 load(std::int16_t const* at) {
  return hn::LoadU(D16(), at);
}
HWY_INLINE V16 constant(std::int16_t value) {
  return hn::Set(D16(), value);
}

void disparity_row_lanes(float const* depth_m, std::size_t count, float units_m,
                         std::int16_t* out) {
  DF const df;
  hn::Rebind<std::int16_t, DF> const half;
  auto const most = hn::Set(df, 32000.0F);
  auto const units = hn::Set(df, units_m);
  for (std::size_t u = 0; u < count; u += hn::Lanes(df)) {
    auto const z = hn::LoadU(df, depth_m + u);
    auto const valid = hn::And(z > hn::Zero(df), z < hn::Set(df, 1e30F));
    auto const value = hn::Min(units / z, most) + hn::Set(df, 0.5F);
    auto const whole = hn::ConvertTo(DI(), hn::IfThenElseZero(valid, value));
    hn::StoreU(hn::DemoteTo(half, whole), half, out + u);
  }
}

/// Sums and counts of one vector, on their way to floats.
struct alignas(64) Lanes16 {
  std::array<std::int16_t, 32> sum;
  std::array<std::int16_t, 32> count;
};

/// sum / count, rounded half to even.
HWY_INLINE V16 quotient(V16 sum, V16 count) {
  D16 const d;
  DF const df;
  DI const di;
  hn::Rebind<std::int16_t, DF> const half;
  Lanes16 lanes;
  hn::Store(sum, d, lanes.sum.data());
  hn::Store(count, d, lanes.count.data());
  for (std::size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(df)) {
    auto const s = hn::PromoteTo(di, hn::LoadU(half, lanes.sum.data() + i));
    auto const n = hn::PromoteTo(di, hn::LoadU(half, lanes.count.data() + i));
    auto const mean = hn::NearestInt(hn::ConvertTo(df, s) / hn::ConvertTo(df, n));
    hn::StoreU(hn::DemoteTo(half, mean), half, lanes.sum.data() + i);
  }
  return hn::Load(d, lanes.sum.data());
}

/// Where every centre is higher than the limit, or invalid, what is invalid is too far from
/// it to count: it need not be asked for.
HWY_INLINE bool invalid_is_far(V16 c, V16 limit) {
  D16 const d;
  return hn::AllTrue(d, hn::Or(c > limit, c == hn::Zero(d)));
}

/// Of the differences from c that count, their sum, and how many they are.
struct WindowSums {
  V16 sum;
  V16 count;
};
template <bool kInvalidIsFar, class Radius>
HWY_INLINE WindowSums window_sums(std::int16_t const* centre, std::ptrdiff_t stride, Radius radius,
                                  V16 c, V16 limit) {
  D16 const d;
  V16 const zero = hn::Zero(d);
  V16 sum = zero;
  V16 count = zero;
  V16 const one = constant(1);
  for (int dv = -radius; dv <= radius; ++dv) {
    std::int16_t const* const row = centre + dv * stride;
    for (int du = -radius; du <= radius; ++du) {
      V16 const other = load(row + du);
      V16 const difference = other - c;
      M16 member = hn::Abs(difference) < limit;
      if constexpr (!kInvalidIsFar) {
        member = hn::And(member, other > zero);
      }
      sum = add_where(member, sum, difference);
      count = add_where(member, count, one);
    }
  }
  return {sum, count};
}

template <class Radius>
HWY_INLINE void smooth_row_within(std::int16_t const* centre, std::ptrdiff_t stride, Radius radius,
                                  std::int16_t limit, std::size_t count, std::int16_t* out) {
  D16 const d;
  V16 const most = constant(limit);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    V16 const c = load(centre + u);
    WindowSums const sums = invalid_is_far(c, most)
                                ? window_sums<true>(centre + u, stride, radius, c, most)
                                : window_sums<false>(centre + u, stride, radius, c, most);
    // Where the centre is invalid the count may be 0, and the result is not used.
    V16 const size = hn::Max(sums.count, constant(1));
    hn::StoreU(hn::IfThenElseZero(c > hn::Zero(d), c + quotient(sums.sum, size)), d, out + u);
  }
}

void smooth_row_lanes(std::int16_t const* centre, std::ptrdiff_t stride, int radius,
                      std::int16_t limit, std::size_t count, std::int16_t* out) {
  // What cameras have by default: without loops.
  using Usual = std::integral_constant<int, 2>;
  if (radius == Usual::value) {
    smooth_row_within(centre, stride, Usual(), limit, count, out);
  } else {
    smooth_row_within(centre, stride, radius, limit, count, out);
  }
}

/// Of one pair: a + b - 2c, and a - b; only where it counts. The centre's own validity is left out.
struct PairHeights {
  M16 counts;
  V16 concavity;
  V16 rise;
};
template <bool kInvalidIsFar>
HWY_INLINE PairHeights heights_of(V16 c, V16 a, V16 b, V16 limit) {
  V16 const to_a = a - c;
  V16 const to_b = b - c;
  M16 one_surface = hn::Max(hn::Abs(to_a), hn::Abs(to_b)) < limit;
  if constexpr (!kInvalidIsFar) {
    one_surface = hn::And(one_surface, hn::Min(a, b) > hn::Zero(D16()));
  }
  return {one_surface, to_a + to_b, to_a - to_b};
}

/// The largest of all pairs; `far` is of those at twice the offsets.
struct Bend {
  V16 near;
  V16 far;
  V16 steepness;
};
template <bool kInvalidIsFar>
HWY_INLINE Bend bend_of(std::int16_t const* at, V16 c, ConcavityPairs const& pairs) {
  V16 const limit = constant(pairs.limit);
  V16 const zero = hn::Zero(D16());
  Bend bend{zero, zero, zero};
  for (std::ptrdiff_t const offset : pairs.offsets) {
    auto const heights = [&](std::ptrdiff_t reach) HWY_ATTR {
      return heights_of<kInvalidIsFar>(c, load(at + reach), load(at - reach), limit);
    };
    PairHeights const near = heights(offset);
    bend.near = max_where(near.counts, bend.near, near.concavity);
    bend.steepness = max_where(near.counts, bend.steepness, hn::Abs(near.rise));
    PairHeights const far = heights(2 * offset);
    bend.far = max_where(far.counts, bend.far, far.concavity);
  }
  return bend;
}

void concavity_row_lanes(std::int16_t const* centre, ConcavityPairs const& pairs, std::size_t count,
                         std::int16_t* concavity, std::int16_t* steepness) {
  D16 const d;
  V16 const weight = constant(pairs.far_weight);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    V16 const c = load(centre + u);
    Bend const bend = invalid_is_far(c, constant(pairs.limit))
                          ? bend_of<true>(centre + u, c, pairs)
                          : bend_of<false>(centre + u, c, pairs);
    M16 const valid = c > hn::Zero(d);
    // Twice the height, so that the upper half of the product is over 2^15.
    V16 const most = hn::Max(bend.near, hn::MulHigh(bend.far + bend.far, weight));
    hn::StoreU(hn::IfThenElseZero(valid, most), d, concavity + u);
    hn::StoreU(hn::IfThenElseZero(valid, bend.steepness), d, steepness + u);
  }
}

/// 1 where the mask is set.
HWY_INLINE void store_bytes(M16 mask, std::uint8_t* out) {
  hn::Rebind<std::uint8_t, D16> const bytes;
  hn::StoreU(hn::DemoteTo(bytes, hn::IfThenElseZero(mask, constant(1))), bytes, out);
}

HWY_INLINE M16 ends_here(V16 c, V16 neighbour, V16 most) {
  return hn::And(neighbour > hn::Zero(D16()), hn::Abs(neighbour - c) > most);
}

void crease_row_lanes(std::int16_t const* disparity, std::ptrdiff_t stride,
                      std::int16_t const* concavity, std::int16_t const* steepness,
                      CreaseLimits const& limits, std::size_t count, std::uint8_t* wall,
                      std::uint8_t* solid) {
  V16 const link = constant(static_cast<std::int16_t>(limits.link - 1));
  for (std::size_t u = 0; u < count; u += hn::Lanes(D16())) {
    V16 const c = load(disparity + u);
    M16 const valid = c > hn::Zero(D16());
    V16 const allowed = hn::SaturatedAdd(constant(limits.crease),
                                         hn::MulHigh(load(steepness + u), constant(limits.slope)));
    M16 const is_wall = hn::And(valid, load(concavity + u) > allowed);
    M16 const jumps = hn::Or(hn::Or(ends_here(c, load(disparity + u - 1), link),
                                    ends_here(c, load(disparity + u + 1), link)),
                             hn::Or(ends_here(c, load(disparity + u - stride), link),
                                    ends_here(c, load(disparity + u + stride), link)));
    store_bytes(is_wall, wall + u);
    store_bytes(hn::AndNot(hn::Or(is_wall, jumps), valid), solid + u);
  }
}

void thicken_row_lanes(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t level,
                       std::size_t count, std::uint8_t* out) {
  D8 const d;
  auto const wanted = hn::Set(d, level);
  auto const one = hn::Set(d, 1);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    auto const column = [&](std::ptrdiff_t du) {
      std::uint8_t const* const at = centre + u + du;
      return hn::Min(hn::LoadU(d, at),
                     hn::Min(hn::LoadU(d, at - stride), hn::LoadU(d, at + stride)));
    };
    auto const least = hn::Min(column(0), hn::Min(column(-1), column(1)));
    auto const c = hn::LoadU(d, centre + u);
    // `least` is at most the centre, which is at most `level`.
    hn::StoreU(c + hn::IfThenElseZero(least == wanted, one), d, out + u);
  }
}

void worth_row_lanes(std::int16_t const* disparity, std::uint8_t const* thickness,
                     std::size_t count, std::uint8_t* out) {
  D16 const d;
  hn::Rebind<std::uint8_t, D16> const bytes;
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    auto const one = hn::IfThenElseZero(load(disparity + u) > hn::Zero(d), constant(1));
    hn::StoreU(hn::DemoteTo(bytes, one) + hn::LoadU(bytes, thickness + u), bytes, out + u);
  }
}

void flood_row_lanes(std::uint8_t const* worth, std::int16_t const* disparity,
                     std::ptrdiff_t stride, std::int16_t const* concavity, std::int16_t link,
                     std::size_t count, std::uint8_t* out) {
  D16 const d;
  hn::Rebind<std::uint8_t, D16> const bytes;
  // Half quanta.
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(kUnitsPerQuantum) / 2);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    V16 const cost =
        hn::Min(hn::ShiftRight<kShift>(load(concavity + u)), constant(kFloodCost - 1)) +
        constant(1);
    M16 const open = hn::PromoteTo(d, hn::LoadU(bytes, worth + u)) > hn::Zero(d);
    V16 const here = load(disparity + u);
    auto const bit_where_linked = [&](std::int16_t const* next, std::int16_t bit) HWY_ATTR {
      return hn::IfThenElseZero(hn::Abs(here - load(next)) < constant(link), constant(bit));
    };
    V16 const links = hn::Or(bit_where_linked(disparity + u + 1, kLinkedRight),
                             bit_where_linked(disparity + u + stride, kLinkedDown));
    hn::StoreU(hn::DemoteTo(bytes, hn::Or(hn::IfThenElseZero(open, cost), links)), bytes, out + u);
  }
}

void at_least_bits_lanes(std::uint8_t const* row, std::uint8_t least, std::size_t count,
                         std::uint64_t* out) {
  D8 const d;
  auto const bound = hn::Set(d, least);
  // a >= b where max(a, b) == a.
  store_bits(
      d, count,
      [&](std::size_t u) HWY_ATTR {
        auto const value = hn::LoadU(d, row + u);
        return hn::Max(value, bound) == value;
      },
      out);
}

void higher_bits_lanes(float const* row, float than, std::size_t count, std::uint64_t* out) {
  DF const d;
  auto const bound = hn::Set(d, than);
  store_bits(
      d, count, [&](std::size_t u) HWY_ATTR { return hn::LoadU(d, row + u) > bound; }, out);
}

void front_bits_lanes(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t least,
                      std::size_t count, std::uint64_t* out) {
  D8 const d;
  auto const bound = hn::Set(d, least);
  store_bits(
      d, count,
      [&](std::size_t u) HWY_ATTR {
        std::uint8_t const* const at = centre + u;
        auto const here = hn::LoadU(d, at);
        auto const beside = hn::Min(hn::LoadU(d, at - 1), hn::LoadU(d, at + 1));
        auto const lowest =
            hn::Min(beside, hn::Min(hn::LoadU(d, at - stride), hn::LoadU(d, at + stride)));
        return hn::And(hn::Max(here, bound) == here, lowest == hn::Zero(d));
      },
      out);
}

}  // namespace credo::segments::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::segments {

HWY_EXPORT(disparity_row_lanes);
HWY_EXPORT(smooth_row_lanes);
HWY_EXPORT(concavity_row_lanes);
HWY_EXPORT(crease_row_lanes);
HWY_EXPORT(thicken_row_lanes);
HWY_EXPORT(worth_row_lanes);
HWY_EXPORT(flood_row_lanes);
HWY_EXPORT(at_least_bits_lanes);
HWY_EXPORT(higher_bits_lanes);
HWY_EXPORT(front_bits_lanes);

void disparity_row(float const* depth_m, std::size_t count, float units_m, std::int16_t* out) {
  HWY_DYNAMIC_DISPATCH(disparity_row_lanes)(depth_m, count, units_m, out);
}

void smooth_row(std::int16_t const* centre, std::ptrdiff_t stride, int radius, std::int16_t limit,
                std::size_t count, std::int16_t* out) {
  HWY_DYNAMIC_DISPATCH(smooth_row_lanes)(centre, stride, radius, limit, count, out);
}

void concavity_row(std::int16_t const* centre, ConcavityPairs const& pairs, std::size_t count,
                   std::int16_t* concavity, std::int16_t* steepness) {
  HWY_DYNAMIC_DISPATCH(concavity_row_lanes)(centre, pairs, count, concavity, steepness);
}

void crease_row(std::int16_t const* disparity, std::ptrdiff_t stride, std::int16_t const* concavity,
                std::int16_t const* steepness, CreaseLimits const& limits, std::size_t count,
                std::uint8_t* wall, std::uint8_t* solid) {
  HWY_DYNAMIC_DISPATCH(crease_row_lanes)
  (disparity, stride, concavity, steepness, limits, count, wall, solid);
}

void thicken_row(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t level,
                 std::size_t count, std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(thicken_row_lanes)(centre, stride, level, count, out);
}

void worth_row(std::int16_t const* disparity, std::uint8_t const* thickness, std::size_t count,
               std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(worth_row_lanes)(disparity, thickness, count, out);
}

void flood_row(std::uint8_t const* worth, std::int16_t const* disparity, std::ptrdiff_t stride,
               std::int16_t const* concavity, std::int16_t link, std::size_t count,
               std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(flood_row_lanes)
  (worth, disparity, stride, concavity, link, count, out);
}

void at_least_bits(std::uint8_t const* row, std::uint8_t least, std::size_t count,
                   std::uint64_t* out) {
  HWY_DYNAMIC_DISPATCH(at_least_bits_lanes)(row, least, count, out);
}

void higher_bits(float const* row, float than, std::size_t count, std::uint64_t* out) {
  HWY_DYNAMIC_DISPATCH(higher_bits_lanes)(row, than, count, out);
}

void front_bits(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t least,
                std::size_t count, std::uint64_t* out) {
  HWY_DYNAMIC_DISPATCH(front_bits_lanes)(centre, stride, least, count, out);
}

}  // namespace credo::segments
#endif
