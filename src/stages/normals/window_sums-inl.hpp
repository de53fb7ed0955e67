// Sums over the samples of a window, once per instruction set: Highway's per-target guard takes the
// place of #pragma once.
#if defined(CREDO_STAGES_NORMALS_WINDOW_SUMS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CREDO_STAGES_NORMALS_WINDOW_SUMS_INL_HPP
#undef CREDO_STAGES_NORMALS_WINDOW_SUMS_INL_HPP
#else
#define CREDO_STAGES_NORMALS_WINDOW_SUMS_INL_HPP
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/mask_lanes-inl.hpp"
#include "stages/normals/lanes-inl.hpp"
#include "stages/normals/plane_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::normals::HWY_NAMESPACE {

/// Moments of some samples about a window's centre: columns and rows in samples, inverse depth
/// relative to the centre's. Those without w are small integers.
struct Moments {
  V n, u, v, uu, uv, vv, w, uw, vw, ww;
};

HWY_INLINE Moments only_where(M where, Moments const& m) {
  return {hn::IfThenElseZero(where, m.n),  hn::IfThenElseZero(where, m.u),
          hn::IfThenElseZero(where, m.v),  hn::IfThenElseZero(where, m.uu),
          hn::IfThenElseZero(where, m.uv), hn::IfThenElseZero(where, m.vv),
          hn::IfThenElseZero(where, m.w),  hn::IfThenElseZero(where, m.uw),
          hn::IfThenElseZero(where, m.vw), hn::IfThenElseZero(where, m.ww)};
}

// What is done once a window and hands over a dozen vectors is HWY_NOINLINE: all in one function
// takes compilers minutes, with sanitizers most of all. What is done for each quadrant is inlined:
// the way through memory would cost a seventh of the time.

/// Sums over the samples of one part of a window. Columns and rows count from the centre outwards
/// (never negative), whichever side the part is on.
struct Sums {
  /// Small integers, three to a lane, kFieldBits each, lowest first. `rows_1` and `rows_2` are
  /// their sums weighted by v and by v (v + 1) / 2. In a part of row or column 0 alone, sums
  /// weighted by that 0 are undefined.
  VI n_u_uu, rows_1, rows_2;
  V w, uw, vw, ww;
};

// Of a whole window no field exceeds the sum of u^2 over 9x9 samples, 540.
constexpr int kFieldBits = 10;

template <int kField>
HWY_INLINE VI field(VI packed) {
  VI const shifted = hn::ShiftRight<kField * kFieldBits>(packed);
  return hn::And(shifted, hn::Set(DI(), (1 << kFieldBits) - 1));
}

HWY_INLINE V to_float(VI value) {
  return hn::ConvertTo(D(), value);
}

/// How far from the centre's inverse depth a sample may be, by the larger of its distances in
/// columns and rows; negative beyond a lane's window.
using TapTolerance = std::array<V, kMaxTaps + 1>;

/// Windows around a vector of centres: the sample of the first, the ways to the next sample to the
/// right and below.
struct Samples {
  float const* centre = nullptr;
  std::ptrdiff_t right = 0;
  std::ptrdiff_t down = 0;
  V centre_w;
  TapTolerance tolerance;
};

/// One sample, u columns and v rows outwards, where it lies within the tolerance.
struct Tap {
  M member;
  VI counts;
  V w;
};
HWY_INLINE Tap tap(Samples const& samples, float const* sample, int u, int v) {
  V const difference = hn::LoadU(D(), sample) - samples.centre_w;
  V const limit = samples.tolerance[static_cast<std::size_t>(u > v ? u : v)];
  M const member = hn::Abs(difference) <= limit;
  VI const counts = hn::Set(DI(), 1 | (u << kFieldBits) | (u * u << (2 * kFieldBits)));
  return {member, counts, hn::IfThenElseZero(member, difference)};
}

/// Columns 1 to kColumns of row v of a part that lies to the left (-1) or right (1) of the centre;
/// column 0 alone for 0.
template <int kColumns, int kSide>
HWY_INLINE Sums row_sums(Samples const& samples, float const* row, int v) {
  // From the outside in: what is added again at every step is weighted by its distance.
  Tap const last = tap(samples, row + kSide * kColumns * samples.right, kColumns, v);
  VI n_u_uu = hn::IfThenElseZero(hn::RebindMask(DI(), last.member), last.counts);
  V w = last.w;
  V uw = last.w;
  V ww = last.w * last.w;
  for (int u = kColumns - 1; u >= 1; --u) {
    Tap const next = tap(samples, row + kSide * u * samples.right, u, v);
    n_u_uu =
        lanes::HWY_NAMESPACE::add_where(hn::RebindMask(DI(), next.member), n_u_uu, next.counts);
    w = w + next.w;
    uw = uw + w;
    ww = ww + next.w * next.w;
  }
  return {n_u_uu, n_u_uu, n_u_uu, w, uw, w, ww};
}

/// Rows 1 to kRows of a part above (-1) or below (1) the centre; row 0 alone for 0.
template <int kColumns, int kSide, int kRows, int kBelow>
HWY_NOINLINE Sums sums_of(Samples const& samples) {
  std::ptrdiff_t const down = kBelow * samples.down;
  Sums sums = row_sums<kColumns, kSide>(samples, samples.centre + kRows * down, kRows);
  for (int v = kRows - 1; v >= 1; --v) {
    Sums const next = row_sums<kColumns, kSide>(samples, samples.centre + v * down, v);
    sums.n_u_uu = sums.n_u_uu + next.n_u_uu;
    sums.rows_1 = sums.rows_1 + sums.n_u_uu;
    sums.rows_2 = sums.rows_2 + sums.rows_1;
    sums.w = sums.w + next.w;
    sums.uw = sums.uw + next.uw;
    sums.vw = sums.vw + sums.w;
    sums.ww = sums.ww + next.ww;
  }
  return sums;
}

/// The nine parts of a window: four corners and four arms around the centre.
struct Parts {
  Sums top_left, top, top_right, left, centre, right, bottom_left, bottom, bottom_right;
};

template <int kTaps>
HWY_INLINE Parts parts_of(Samples const& samples) {
  return {sums_of<kTaps, -1, kTaps, -1>(samples), sums_of<0, 0, kTaps, -1>(samples),
          sums_of<kTaps, 1, kTaps, -1>(samples),  sums_of<kTaps, -1, 0, 0>(samples),
          sums_of<0, 0, 0, 0>(samples),           sums_of<kTaps, 1, 0, 0>(samples),
          sums_of<kTaps, -1, kTaps, 1>(samples),  sums_of<0, 0, kTaps, 1>(samples),
          sums_of<kTaps, 1, kTaps, 1>(samples)};
}

/// Moments of a corner with its two arms and the centre, columns and rows counted outwards.
HWY_INLINE Moments quadrant(Sums const& corner, Sums const& above, Sums const& beside,
                            Sums const& centre) {
  VI const n_u_uu = (corner.n_u_uu + above.n_u_uu) + (beside.n_u_uu + centre.n_u_uu);
  VI const rows_1 = corner.rows_1 + above.rows_1;
  VI const rows_2 = field<0>(corner.rows_2 + above.rows_2);
  V const v = to_float(field<0>(rows_1));
  return {to_float(field<0>(n_u_uu)),
          to_float(field<1>(n_u_uu)),
          v,
          to_float(field<2>(n_u_uu)),
          to_float(field<1>(rows_1)),
          to_float(rows_2 + rows_2) - v,
          (corner.w + above.w) + (beside.w + centre.w),
          corner.uw + beside.uw,
          corner.vw + above.vw,
          (corner.ww + above.ww) + (beside.ww + centre.ww)};
}

template <int kSign>
HWY_INLINE V signed_sum(V a, V b) {
  return kSign > 0 ? a + b : a - b;
}

/// A quadrant's moments with columns to the right and rows down, added to `sum` in some
/// lanes: kRight and kDown are 1, or -1 where it lies to the left or above.
template <int kRight, int kDown>
HWY_INLINE void add_quadrant(M where, Moments const& quadrant, Moments& sum) {
  Moments const m = only_where(where, quadrant);
  sum.n = sum.n + m.n;
  sum.u = signed_sum<kRight>(sum.u, m.u);
  sum.v = signed_sum<kDown>(sum.v, m.v);
  sum.uu = sum.uu + m.uu;
  sum.uv = signed_sum<kRight * kDown>(sum.uv, m.uv);
  sum.vv = sum.vv + m.vv;
  sum.w = sum.w + m.w;
  sum.uw = signed_sum<kRight>(sum.uw, m.uw);
  sum.vw = signed_sum<kDown>(sum.vw, m.vw);
  sum.ww = sum.ww + m.ww;
}

template <V Sums::*kSum>
HWY_INLINE V total(Parts const& p) {
  V const corners =
      (p.top_left.*kSum + p.top_right.*kSum) + (p.bottom_left.*kSum + p.bottom_right.*kSum);
  V const arms = (p.top.*kSum + p.bottom.*kSum) + (p.left.*kSum + p.right.*kSum);
  return (corners + arms) + p.centre.*kSum;
}

/// Moments of a whole window, columns to the right and rows down.
inline HWY_NOINLINE Moments whole(Parts const& p) {
  VI const left = (p.top_left.n_u_uu + p.bottom_left.n_u_uu) + p.left.n_u_uu;
  VI const right = (p.top_right.n_u_uu + p.bottom_right.n_u_uu) + p.right.n_u_uu;
  VI const all = (left + right) + (p.top.n_u_uu + p.bottom.n_u_uu + p.centre.n_u_uu);
  VI const up = (p.top_left.rows_1 + p.top_right.rows_1) + p.top.rows_1;
  VI const down = (p.bottom_left.rows_1 + p.bottom_right.rows_1) + p.bottom.rows_1;
  VI const along = p.top_left.rows_1 + p.bottom_right.rows_1;
  VI const across = p.top_right.rows_1 + p.bottom_left.rows_1;
  // Apart: all together the highest field, which nobody reads, would overflow.
  VI const rows_2 = field<0>((p.top_left.rows_2 + p.top_right.rows_2) + p.top.rows_2) +
                    field<0>((p.bottom_left.rows_2 + p.bottom_right.rows_2) + p.bottom.rows_2);
  return {to_float(field<0>(all)),
          to_float(field<1>(right) - field<1>(left)),
          to_float(field<0>(down) - field<0>(up)),
          to_float(field<2>(all)),
          to_float(field<1>(along) - field<1>(across)),
          to_float((rows_2 + rows_2) - field<0>(up + down)),
          total<&Sums::w>(p),
          ((p.top_right.uw + p.bottom_right.uw) + p.right.uw) -
              ((p.top_left.uw + p.bottom_left.uw) + p.left.uw),
          ((p.bottom_left.vw + p.bottom_right.vw) + p.bottom.vw) -
              ((p.top_left.vw + p.top_right.vw) + p.top.vw),
          total<&Sums::ww>(p)};
}

}  // namespace credo::normals::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
