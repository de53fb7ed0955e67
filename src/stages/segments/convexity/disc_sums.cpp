#include "stages/segments/convexity/disc_sums.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "stages/segments/convexity/disc_sums.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "geometry/mask_lanes-inl.hpp"

#include "stages/segments/convexity/limits.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::segments::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using lanes::HWY_NAMESPACE::add_where;
using lanes::HWY_NAMESPACE::bits_of;

using DiscLanes = hn::CappedTag<std::int32_t, 16>;
using DiscVec = hn::Vec<DiscLanes>;

/// Of some pixels what DiscSums adds up, but for what their number tells; the squares of
/// disparities in two halves.
enum Term : std::size_t { kU, kD, kUU, kUV, kUD, kVD, kLowDD, kHighDD, kTerms };
using Terms = std::array<DiscVec, kTerms>;

HWY_INLINE Terms terms_at(std::int16_t const* disparity, DiscVec u, int row_v) {
  DiscLanes const d;
  hn::Rebind<std::int16_t, DiscLanes> const half;
  DiscVec const low = hn::Set(d, 0xFFFF);
  DiscVec const v = hn::Set(d, row_v);
  hn::Vec<decltype(half)> of_each;
  hn::Vec<decltype(half)> between;
  hn::LoadInterleaved2(half, disparity, of_each, between);
  DiscVec const disparities = hn::PromoteTo(d, of_each);
  DiscVec const dd = disparities * disparities;
  return {u,
          disparities,
          u * u,
          u * v,
          u * disparities,
          v * disparities,
          hn::And(dd, low),
          hn::ShiftRight<16>(dd)};
}

HWY_INLINE void add_terms_where(hn::Mask<DiscLanes> where, Terms const& terms, Terms& sums) {
  for (std::size_t i = 0; i < kTerms; ++i) {
    sums[i] = add_where(where, sums[i], terms[i]);
  }
}

/// Where the mask is set: how many pixels, and what that tells of a row of them.
HWY_INLINE void add_number(hn::Mask<DiscLanes> where, std::int64_t row_v, DiscSums& sums) {
  std::int64_t const number = std::popcount(bits_of(DiscLanes(), where));
  sums.n += number;
  sums.v += row_v * number;
  sums.vv += row_v * row_v * number;
}

HWY_INLINE void add_lanes(Terms const& lanes, DiscSums& sums) {
  auto const sum = [&](Term term) HWY_ATTR {
    DiscLanes const d;
    return std::int64_t{hn::GetLane(hn::SumOfLanes(d, lanes[term]))};
  };
  sums.u += sum(kU);
  sums.d += sum(kD);
  sums.uu += sum(kUU);
  sums.uv += sum(kUV);
  sums.ud += sum(kUD);
  sums.vd += sum(kVD);
  sums.dd += sum(kLowDD) + (sum(kHighDD) << 16);
}

/// Of so few rows that the sums fit 32 bits.
HWY_INLINE void add_rows(DiscCentre const& centre, std::span<DiscRow const> rows,
                         std::int32_t label_a, std::int32_t label_b, TwoSums& sums) {
  DiscLanes const d;
  DiscVec const a = hn::Set(d, label_a);
  DiscVec const b = hn::Set(d, label_b);
  DiscVec const columns = hn::Iota(d, 0) + hn::Iota(d, 0);
  Terms sums_a;
  sums_a.fill(hn::Zero(d));
  Terms sums_b = sums_a;
  for (DiscRow const& row : rows) {
    DiscVec const end = hn::Set(d, row.last_u + 1);
    for (int u = row.first_u; u <= row.last_u; u += 2 * static_cast<int>(hn::Lanes(d))) {
      std::ptrdiff_t const at = row.v * centre.stride + u;
      DiscVec labels;
      DiscVec between;
      hn::LoadInterleaved2(d, centre.label + at, labels, between);
      DiscVec const us = hn::Set(d, u) + columns;
      auto const inside = us < end;
      Terms const terms = terms_at(centre.disparity + at, us, row.v);
      auto const on_a = hn::And(inside, labels == a);
      auto const on_b = hn::And(inside, labels == b);
      add_terms_where(on_a, terms, sums_a);
      add_terms_where(on_b, terms, sums_b);
      add_number(on_a, row.v, sums.a);
      add_number(on_b, row.v, sums.b);
    }
  }
  add_lanes(sums_a, sums.a);
  add_lanes(sums_b, sums.b);
}

TwoSums disc_sums_lanes(DiscCentre const& centre, std::span<DiscRow const> rows,
                        std::int32_t label_a, std::int32_t label_b) {
  // The largest terms are products of a distance and a disparity below 2^15.
  int radius = 1;
  for (DiscRow const& row : rows) {
    radius = std::max({radius, std::abs(row.v), -row.first_u, row.last_u});
  }
  auto const at_once = static_cast<std::size_t>((1 << 16) / (radius * (radius + 1)));
  TwoSums sums;
  while (!rows.empty()) {
    std::size_t const some = std::min(at_once, rows.size());
    add_rows(centre, rows.first(some), label_a, label_b, sums);
    rows = rows.subspan(some);
  }
  return sums;
}

}  // namespace credo::segments::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::segments {

HWY_EXPORT(disc_sums_lanes);

TwoSums disc_sums(DiscCentre const& centre, std::span<DiscRow const> rows, std::int32_t label_a,
                  std::int32_t label_b) {
  return HWY_DYNAMIC_DISPATCH(disc_sums_lanes)(centre, rows, label_a, label_b);
}

}  // namespace credo::segments
#endif
