#include "stages/segments/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/segments/kernels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::segments::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

void smooth_row_lanes(std::int16_t const* centre, std::ptrdiff_t stride, int radius,
                      std::int16_t limit, std::size_t count, std::int16_t* out) {
  D16 const d;
  V16 const zero = hn::Zero(d);
  V16 const most = constant(limit);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    V16 const c = load(centre + u);
    V16 sum = zero;
    V16 minus_count = zero;
    for (int dv = -radius; dv <= radius; ++dv) {
      std::int16_t const* const row = centre + dv * stride + u;
      for (int du = -radius; du <= radius; ++du) {
        V16 const other = load(row + du);
        V16 const difference = other - c;
        M16 const member = hn::And(hn::Abs(difference) < most, other > zero);
        sum = sum + hn::IfThenElseZero(member, difference);
        minus_count = minus_count + hn::VecFromMask(d, member);
      }
    }
    // Where the centre is invalid the count may be 0, and the result is not used.
    V16 const size = hn::Max(zero - minus_count, constant(1));
    hn::StoreU(hn::IfThenElseZero(c > zero, c + quotient(sum, size)), d, out + u);
  }
}

/// Of one pair: a + b - 2c, and |a - b|; 0 where it does not count.
struct PairHeights {
  V16 concavity;
  V16 steepness;
};
HWY_INLINE PairHeights heights_of(V16 c, V16 a, V16 b, V16 most) {
  V16 const zero = hn::Zero(D16());
  V16 const to_a = a - c;
  V16 const to_b = b - c;
  M16 const near = hn::And(hn::Abs(to_a) < most, hn::Abs(to_b) < most);
  M16 const valid = hn::And(hn::And(a > zero, b > zero), c > zero);
  M16 const one_surface = hn::And(near, valid);
  return {hn::IfThenElseZero(one_surface, to_a + to_b),
          hn::IfThenElseZero(one_surface, hn::Abs(to_a - to_b))};
}

void concavity_row_lanes(std::int16_t const* centre, ConcavityPairs const& pairs, std::size_t count,
                         std::int16_t* concavity, std::int16_t* steepness) {
  D16 const d;
  V16 const zero = hn::Zero(d);
  V16 const most = constant(pairs.limit);
  V16 const weight = constant(pairs.far_weight);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    std::int16_t const* const at = centre + u;
    V16 const c = load(at);
    V16 largest = zero;
    V16 farther = zero;
    V16 steepest = zero;
    for (std::ptrdiff_t const offset : pairs.offsets) {
      PairHeights const near = heights_of(c, load(at + offset), load(at - offset), most);
      largest = hn::Max(largest, near.concavity);
      steepest = hn::Max(steepest, near.steepness);
      PairHeights const far = heights_of(c, load(at + 2 * offset), load(at - 2 * offset), most);
      farther = hn::Max(farther, far.concavity);
    }
    // Twice the height, so that the upper half of the product is over 2^15.
    hn::StoreU(hn::Max(largest, hn::MulHigh(farther + farther, weight)), d, concavity + u);
    hn::StoreU(steepest, d, steepness + u);
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

void front_row_lanes(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t least,
                     std::size_t count, std::uint8_t* out) {
  D8 const d;
  // a >= b where max(a, b) == a.
  auto const bound = hn::Set(d, least);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    std::uint8_t const* const at = centre + u;
    auto const beside = hn::Max(hn::LoadU(d, at - 1), hn::LoadU(d, at + 1));
    auto const most =
        hn::Max(beside, hn::Max(hn::LoadU(d, at - stride), hn::LoadU(d, at + stride)));
    auto const is_front = hn::And(hn::Max(most, bound) == most, hn::LoadU(d, at) == hn::Zero(d));
    hn::StoreU(hn::IfThenElseZero(is_front, most), d, out + u);
  }
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
HWY_EXPORT(front_row_lanes);

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

void front_row(std::uint8_t const* centre, std::ptrdiff_t stride, std::uint8_t least,
               std::size_t count, std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(front_row_lanes)(centre, stride, least, count, out);
}

}  // namespace credo::segments
#endif
