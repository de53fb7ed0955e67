#include "stages/normals/plane_kernel.hpp"

#include <cstdlib>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/normals/plane_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "stages/normals/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::normals::HWY_NAMESPACE {

/// Moments of some samples of a window about its centre: columns and rows in samples, inverse depth
/// relative to the centre's. Those without w are small integers.
struct Moments {
  V n, u, v, uu, uv, vv, w, uw, vw, ww;
};

Moments no_samples() {
  V const zero = hn::Zero(D());
  return {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
}

Moments sum_of(Moments const& a, Moments const& b) {
  return {a.n + b.n,   a.u + b.u, a.v + b.v,   a.uu + b.uu, a.uv + b.uv,
          a.vv + b.vv, a.w + b.w, a.uw + b.uw, a.vw + b.vw, a.ww + b.ww};
}

Moments only_where(M where, Moments const& m) {
  auto const keep = [&](V x) { return hn::IfThenElseZero(where, x); };
  return {keep(m.n),  keep(m.u), keep(m.v),  keep(m.uu), keep(m.uv),
          keep(m.vv), keep(m.w), keep(m.uw), keep(m.vw), keep(m.ww)};
}

/// The window of a block: `taps` samples to each side, `step` blocks apart.
struct Window {
  V centre_w;
  V tolerance;
  V taps;
  V step;
};

Window window_of(V centre_w, FitParams const& params) {
  V const wanted_px =
      hn::Max(constant(params.radius_focal_m_px) * centre_w, constant(params.min_radius_px));
  V const radius_blocks = constant(0.5F) * hn::Min(wanted_px, constant(params.max_radius_px));
  auto const reach = static_cast<float>(kMaxTaps + 1);
  V const far_step =
      hn::IfThenElse(radius_blocks < constant(2.0F * reach), constant(2.0F), constant(4.0F));
  V const step = hn::IfThenElse(radius_blocks < constant(reach), constant(1.0F), far_step);
  // A sample stands for the whole step around it: r samples to each side reach (r + 1/2) steps.
  V const taps = hn::Min(hn::Floor(radius_blocks / step), constant(kMaxTaps));
  return {centre_w, tolerance_at(centre_w, params.tolerance), taps, step};
}

/// Columns and rows of a window: from -1 or 0 to 0 or 1 times its taps.
struct Part {
  int left, right, top, bottom;
};
constexpr Part kWhole = {-1, 1, -1, 1};
// They share the row and the column of the centre.
constexpr std::array<Part, 4> kQuadrants = {Part{-1, 0, -1, 0}, Part{0, 1, -1, 0},
                                            Part{-1, 0, 0, 1}, Part{0, 1, 0, 1}};

/// How far from the centre's inverse depth a sample may be, by its distance in taps; negative
/// beyond a lane's window.
using TapTolerance = std::array<V, kMaxTaps + 1>;

/// The samples of a part of the windows, `step` blocks apart, that lie within the tolerance.
Moments gather(float const* level, std::ptrdiff_t stride, int step, int taps, Part const& part,
               TapTolerance const& tolerance, V centre_w) {
  V const one = constant(1.0F);
  Moments sum = no_samples();
  for (int dv = part.top * taps; dv <= part.bottom * taps; ++dv) {
    float const* samples = level + dv * step * stride;
    V const row_tolerance = tolerance[static_cast<std::size_t>(std::abs(dv))];
    Moments row = no_samples();
    for (int du = part.left * taps; du <= part.right * taps; ++du) {
      V const difference = hn::LoadU(D(), samples + du * step) - centre_w;
      V const limit = hn::Min(row_tolerance, tolerance[static_cast<std::size_t>(std::abs(du))]);
      M const member = hn::Abs(difference) <= limit;
      V const offset = constant(static_cast<float>(du));
      V const w = hn::IfThenElseZero(member, difference);
      row.n = row.n + hn::IfThenElseZero(member, one);
      row.u = row.u + hn::IfThenElseZero(member, offset);
      row.uu = row.uu + hn::IfThenElseZero(member, offset * offset);
      row.w = row.w + w;
      row.uw = row.uw + w * offset;
      row.ww = row.ww + w * w;
    }
    V const offset = constant(static_cast<float>(dv));
    row.v = offset * row.n;
    row.uv = offset * row.u;
    row.vv = offset * row.v;
    row.vw = offset * row.w;
    sum = sum_of(sum, row);
  }
  return sum;
}

Moments moments_of(LevelRows const& samples, Window const& window, Part const& part, M valid) {
  D const d;
  Moments sum = no_samples();
  for (std::size_t level = 0; level < kLevels; ++level) {
    int const step = 1 << level;
    M const here = hn::And(valid, window.step == constant(static_cast<float>(step)));
    if (hn::AllFalse(d, here)) {
      continue;
    }
    int const taps =
        static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(here, window.taps))));
    // Lanes with a smaller window, or another sampling distance, accept nothing beyond it.
    TapTolerance tolerance;
    for (std::size_t k = 0; k < tolerance.size(); ++k) {
      M const inside = hn::And(here, window.taps >= constant(static_cast<float>(k)));
      tolerance[k] = hn::IfThenElse(inside, window.tolerance, constant(-1.0F));
    }
    sum = sum_of(sum, gather(samples.levels[level], samples.stride, step, taps, part, tolerance,
                             window.centre_w));
  }
  return sum;
}

/// The least-squares plane of some samples: w = a u + b v + c from the window's centre, in samples.
struct Fit {
  V a, b, c;
  /// Mean squared residual; huge where the samples do not span a plane.
  V variance;
  M spans;
};

Fit fit(Moments const& m) {
  // Second moments about the mean, times n^2. Those of u and v are integers below 2^24, so exact.
  V const uu = m.n * m.uu - m.u * m.u;
  V const uv = m.n * m.uv - m.u * m.v;
  V const vv = m.n * m.vv - m.v * m.v;
  V const uw = m.n * m.uw - m.u * m.w;
  V const vw = m.n * m.vw - m.v * m.w;
  V const ww = m.n * m.ww - m.w * m.w;
  V const det = uu * vv - uv * uv;
  // det / trace is about the variance across the narrowest direction: one line of samples has 0,
  // two lines have 1/4.
  constexpr float kLeastSpread = 0.19F;
  V const n2 = m.n * m.n;
  M const spans = det > constant(kLeastSpread) * n2 * (uu + vv);
  V const a = (uw * vv - vw * uv) / det;
  V const b = (vw * uu - uw * uv) / det;
  V const variance = hn::Max(ww - a * uw - b * vw, hn::Zero(D())) / n2;
  return {a, b, (m.w - a * m.u - b * m.v) / m.n, hn::IfThenElse(spans, variance, constant(1e30F)),
          spans};
}

/// The moments that the normal is fitted to: the whole window where one plane explains it, else
/// those of its quadrants that lie flat beside the crease or step. On a rounded surface all four
/// are alike, and stay.
Moments best_moments(LevelRows const& samples, Window const& window, M valid) {
  // Standard deviation that noise explains, as a share of the tolerance.
  constexpr float kNoiseShare = 0.1F;
  // How much less flat than the flattest a quadrant may be, in variance; and what is always flat.
  constexpr float kAlike = 3.0F;
  constexpr float kFlat = 0.5F;
  Moments const whole = moments_of(samples, window, kWhole, valid);
  V const noise = constant(kNoiseShare) * window.tolerance;
  V const noise2 = noise * noise;
  M const bent = hn::And(valid, fit(whole).variance > noise2);
  if (hn::AllFalse(D(), bent)) {
    return whole;
  }
  std::array<Moments, 4> quadrant;
  std::array<V, 4> variance;
  for (std::size_t q = 0; q < quadrant.size(); ++q) {
    quadrant[q] = moments_of(samples, window, kQuadrants[q], bent);
    variance[q] = fit(quadrant[q]).variance;
  }
  V const least = hn::Min(hn::Min(variance[0], variance[1]), hn::Min(variance[2], variance[3]));
  V const limit = hn::Max(constant(kAlike) * least, constant(kFlat) * noise2);
  Moments sum = only_where(hn::Not(bent), whole);
  for (std::size_t q = 0; q < quadrant.size(); ++q) {
    sum = sum_of(sum, only_where(hn::And(bent, variance[q] <= limit), quadrant[q]));
  }
  return sum;
}

struct Normal {
  V x, y, z;
};

/// The plane through the moments as a normal towards the camera; NaN where they do not carry one.
/// (u, v) is the block's centre in pixels from the principal point.
Normal normal_of(Moments const& m, Window const& window, V u, V v, M valid,
                 FitParams const& params) {
  Fit const plane = fit(m);
  V const side = window.taps + window.taps + constant(1.0F);
  M const carried = hn::And(m.n >= constant(params.min_support) * side * side, plane.spans);
  // From samples to pixels. Means over an even number of blocks lie half a block up and left.
  V const per_px = constant(0.5F) / window.step;
  V const a = plane.a * per_px;
  V const b = plane.b * per_px;
  V const off_px = hn::IfThenElseZero(window.step > constant(1.0F), constant(1.0F));
  V const offset_w = plane.c + (a + b) * off_px;
  V const w = window.centre_w + offset_w;
  // The plane must pass the point itself, and lie before the camera at all of the block's pixels.
  M const through = hn::Abs(offset_w) <= window.tolerance;
  M const in_front = w - constant(0.5F) * (hn::Abs(a) + hn::Abs(b)) > hn::Zero(D());
  // w = a u + b v + c is m . (x, y, z) = 1 with m = (a fx, b fy, c at the principal point).
  V const mx = a * constant(params.fx_px);
  V const my = b * constant(params.fy_px);
  V const mz = w - a * u - b * v;
  V const scale = constant(-1.0F) / hn::Sqrt(mx * mx + my * my + mz * mz);
  M const ok = hn::And(hn::And(valid, carried), hn::And(in_front, through));
  V const nan = constant(std::numeric_limits<float>::quiet_NaN());
  return {hn::IfThenElse(ok, mx * scale, nan), hn::IfThenElse(ok, my * scale, nan),
          hn::IfThenElse(ok, mz * scale, nan)};
}

void fit_normals_lanes(LevelRows const& samples, int row, float const* centre_w, std::size_t count,
                       FitParams const& params, VectorRow const& normal) {
  D const d;
  V const v = constant(static_cast<float>(2 * row) + 0.5F - params.cy_px);
  for (std::size_t column = 0; column < count; column += hn::Lanes(d)) {
    V const centre = hn::LoadU(d, centre_w + column);
    M const valid = centre > hn::Zero(d);
    V const nan = constant(std::numeric_limits<float>::quiet_NaN());
    Normal n{nan, nan, nan};
    if (!hn::AllFalse(d, valid)) {
      LevelRows here = samples;
      for (float const*& level : here.levels) {
        level += column;
      }
      Window const window = window_of(centre, params);
      V const u =
          hn::Iota(d, static_cast<float>(column)) * constant(2.0F) + constant(0.5F - params.cx_px);
      n = normal_of(best_moments(here, window, valid), window, u, v, valid, params);
    }
    hn::StoreU(n.x, d, normal[0] + column);
    hn::StoreU(n.y, d, normal[1] + column);
    hn::StoreU(n.z, d, normal[2] + column);
  }
}

}  // namespace credo::normals::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::normals {

HWY_EXPORT(fit_normals_lanes);

void fit_normals(LevelRows const& samples, int row, float const* centre_w, std::size_t count,
                 FitParams const& params, VectorRow const& normal) {
  HWY_DYNAMIC_DISPATCH(fit_normals_lanes)(samples, row, centre_w, count, params, normal);
}

}  // namespace credo::normals
#endif
