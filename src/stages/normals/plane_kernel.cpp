#include "stages/normals/plane_kernel.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/normals/plane_kernel.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "stages/normals/lanes-inl.hpp"
#include "stages/normals/window_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::normals::HWY_NAMESPACE {

/// The windows of some blocks that sample the same level.
struct Window {
  V centre_w;
  V tolerance;
  /// Samples to each side.
  V taps;
};

/// Half the windows' width in blocks.
HWY_INLINE V radius_blocks(V centre_w, FitParams const& params) {
  V const wanted_px =
      hn::Max(constant(params.radius_focal_m_px) * centre_w, constant(params.min_radius_px));
  return constant(0.5F) * hn::Min(wanted_px, constant(params.max_radius_px));
}

/// The level of which a window of that size takes its samples: a sample stands for the whole step
/// around it, so that r samples to each side reach (r + 1/2) steps.
HWY_INLINE V level_of(V radius) {
  auto const reach = static_cast<float>(kMaxTaps + 1);
  V const coarse = hn::IfThenElse(radius < constant(2.0F * reach), constant(1.0F), constant(2.0F));
  return hn::IfThenElseZero(radius >= constant(reach), coarse);
}

/// The least-squares plane of some samples: w = a u + b v + c from the window's centre, in samples;
/// `spans` where they carry one.
struct Fit {
  /// How many.
  V n;
  V a, b, c;
  M spans;
};

/// Second moments about the mean, times n^2. Those of u and v are integers below 2^24, so exact.
struct CentralMoments {
  V uu, uv, vv, uw, vw, ww;
  V det;
  V n2;

  HWY_INLINE explicit CentralMoments(Moments const& m)
      : uu(m.n * m.uu - m.u * m.u),
        uv(m.n * m.uv - m.u * m.v),
        vv(m.n * m.vv - m.v * m.v),
        uw(m.n * m.uw - m.u * m.w),
        vw(m.n * m.vw - m.v * m.w),
        ww(m.n * m.ww - m.w * m.w),
        det(uu * vv - uv * uv),
        n2(m.n * m.n) {}

  /// a and b, times det.
  [[nodiscard]] HWY_INLINE V a_det() const { return uw * vv - vw * uv; }
  [[nodiscard]] HWY_INLINE V b_det() const { return vw * uu - uw * uv; }
  [[nodiscard]] HWY_INLINE M spans() const {
    // det / trace is about the variance across the narrowest direction: one line of samples has 0,
    // two lines have 1/4.
    constexpr float kLeastSpread = 0.19F;
    return det > constant(kLeastSpread) * n2 * (uu + vv);
  }
};

HWY_INLINE Fit fit(Moments const& m) {
  CentralMoments const about(m);
  V const a = about.a_det() / about.det;
  V const b = about.b_det() / about.det;
  return {m.n, a, b, (m.w - a * m.u - b * m.v) / m.n, about.spans()};
}

/// Mean squared residual of the plane; huge where the samples do not span one. With one division:
/// these take longest, and most windows are asked five times.
HWY_INLINE V variance_of(Moments const& m) {
  CentralMoments const about(m);
  V const explained_det = about.a_det() * about.uw + about.b_det() * about.vw;
  V const variance =
      hn::Max(about.ww * about.det - explained_det, hn::Zero(D())) / (about.det * about.n2);
  return hn::IfThenElse(about.spans(), variance, constant(1e30F));
}

/// The moments that the normal is fitted to: the whole window where one plane explains it, else
/// those of its quadrants that lie flat beside the crease or step. On a rounded surface all four
/// are alike, and stay.
template <int kTaps>
HWY_INLINE Fit best_fit(float const* centre, std::ptrdiff_t stride, int step, Window const& window,
                        M valid) {
  // Standard deviation that noise explains, as a share of the tolerance.
  constexpr float kNoiseShare = 0.1F;
  // How much less flat than the flattest a quadrant may be, in variance; and what is always flat.
  constexpr float kAlike = 3.0F;
  constexpr float kFlat = 0.5F;
  Samples samples{centre, step, step * stride, window.centre_w, {}};
  for (std::size_t k = 0; k < samples.tolerance.size(); ++k) {
    M const inside = hn::And(valid, window.taps >= constant(static_cast<float>(k)));
    samples.tolerance[k] = hn::IfThenElse(inside, window.tolerance, constant(-1.0F));
  }
  Parts const parts = parts_of<kTaps>(samples);
  Moments sum = whole(parts);
  V const noise = constant(kNoiseShare) * window.tolerance;
  V const noise2 = noise * noise;
  M const bent = hn::And(valid, variance_of(sum) > noise2);
  if (hn::AllFalse(D(), bent)) {
    return fit(sum);
  }
  std::array<Moments, 4> const quadrants = {
      quadrant(parts.top_left, parts.top, parts.left, parts.centre),
      quadrant(parts.top_right, parts.top, parts.right, parts.centre),
      quadrant(parts.bottom_left, parts.bottom, parts.left, parts.centre),
      quadrant(parts.bottom_right, parts.bottom, parts.right, parts.centre)};
  std::array<V, 4> variance;
  for (std::size_t q = 0; q < quadrants.size(); ++q) {
    variance[q] = variance_of(quadrants[q]);
  }
  V const least = hn::Min(hn::Min(variance[0], variance[1]), hn::Min(variance[2], variance[3]));
  V const limit = hn::Max(constant(kAlike) * least, constant(kFlat) * noise2);
  sum = only_where(hn::Not(bent), sum);
  add_quadrant<-1, -1>(hn::And(bent, variance[0] <= limit), quadrants[0], sum);
  add_quadrant<1, -1>(hn::And(bent, variance[1] <= limit), quadrants[1], sum);
  add_quadrant<-1, 1>(hn::And(bent, variance[2] <= limit), quadrants[2], sum);
  add_quadrant<1, 1>(hn::And(bent, variance[3] <= limit), quadrants[3], sum);
  return fit(sum);
}

struct Normal {
  V x, y, z;
};

/// The plane through the moments as a normal towards the camera; NaN where they do not carry one.
/// (u, v) is the block's centre in pixels from the principal point.
HWY_INLINE Normal normal_of(Fit const& plane, Window const& window, int step, V u, V v, M valid,
                            FitParams const& params) {
  V const side = window.taps + window.taps + constant(1.0F);
  M const carried = hn::And(plane.n >= constant(params.min_support) * side * side, plane.spans);
  // From samples to pixels. Means over an even number of blocks lie half a block up and left.
  V const per_px = constant(0.5F / static_cast<float>(step));
  V const a = plane.a * per_px;
  V const b = plane.b * per_px;
  V const off_px = constant(step > 1 ? 1.0F : 0.0F);
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

template <int kTaps>
HWY_INLINE Normal normal_at(float const* samples, std::ptrdiff_t stride, int step,
                            Window const& window, V u, V v, M valid, FitParams const& params) {
  Fit const plane = best_fit<kTaps>(samples, stride, step, window, valid);
  return normal_of(plane, window, step, u, v, valid, params);
}

/// Normals of a vector of blocks, those of each level apart.
HWY_INLINE Normal normals_at(LevelRows const& samples, std::size_t column, V centre_w, V u, V v,
                             FitParams const& params) {
  D const d;
  V const nan = constant(std::numeric_limits<float>::quiet_NaN());
  Normal result{nan, nan, nan};
  M const valid = centre_w > hn::Zero(d);
  if (hn::AllFalse(d, valid)) {
    return result;
  }
  V const radius = radius_blocks(centre_w, params);
  V const level_wanted = level_of(radius);
  V const tolerance = tolerance_at(centre_w, params.tolerance);
  for (std::size_t level = 0; level < kLevels; ++level) {
    M const here = hn::And(valid, level_wanted == constant(static_cast<float>(level)));
    if (hn::AllFalse(d, here)) {
      continue;
    }
    int const step = 1 << level;
    V const taps =
        hn::Min(hn::Floor(radius * constant(1.0F / static_cast<float>(step))), constant(kMaxTaps));
    Window const window{centre_w, tolerance, taps};
    auto const most =
        static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(here, taps))));
    float const* const centre = samples.levels[level] + column;
    auto const at = most <= 2 ? normal_at<2> : most == 3 ? normal_at<3> : normal_at<kMaxTaps>;
    Normal const n = at(centre, samples.stride, step, window, u, v, here, params);
    result = {hn::IfThenElse(here, n.x, result.x), hn::IfThenElse(here, n.y, result.y),
              hn::IfThenElse(here, n.z, result.z)};
  }
  return result;
}

void fit_normals_lanes(LevelRows const& samples, int row, float const* centre_w, std::size_t count,
                       FitParams const& params, VectorRow const& normal) {
  D const d;
  V const v = constant(static_cast<float>(2 * row) + 0.5F - params.cy_px);
  for (std::size_t column = 0; column < count; column += hn::Lanes(d)) {
    V const u =
        hn::Iota(d, static_cast<float>(column)) * constant(2.0F) + constant(0.5F - params.cx_px);
    Normal const n = normals_at(samples, column, hn::LoadU(d, centre_w + column), u, v, params);
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
