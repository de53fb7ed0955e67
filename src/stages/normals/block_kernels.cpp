#include "stages/normals/block_kernels.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/normals/block_kernels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "stages/normals/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::normals::HWY_NAMESPACE {

// Depths outside are invalid: no sensor measures them, and their squares would overflow.
constexpr float kShallowest = 1e-3F;
constexpr float kDeepest = 1e6F;

using Four = std::array<V, 4>;

/// Mean of those of four values that are members; kNothing where none is.
HWY_INLINE V mean_of(Four const& value, std::array<M, 4> const& member) {
  auto const pick = [&](std::size_t i) { return hn::IfThenElseZero(member[i], value[i]); };
  auto const one = [&](std::size_t i) { return hn::IfThenElseZero(member[i], constant(1.0F)); };
  V const sum = (pick(0) + pick(1)) + (pick(2) + pick(3));
  V const count = (one(0) + one(1)) + (one(2) + one(3));
  return hn::IfThenElse(count > hn::Zero(D()), sum / count, constant(kNothing));
}

/// The depths of a vector of blocks, kDeepest where invalid.
HWY_INLINE Four load_blocks(PixelRows const& pixels, std::size_t u) {
  D const d;
  V const deepest = constant(kDeepest);
  Four z;
  hn::LoadInterleaved2(d, pixels.top_m + 2 * u, z[0], z[1]);
  hn::LoadInterleaved2(d, pixels.bottom_m + 2 * u, z[2], z[3]);
  for (V& depth : z) {
    M const valid = hn::And(depth >= constant(kShallowest), depth < deepest);
    depth = hn::IfThenElse(valid, depth, deepest);
  }
  return z;
}

/// Up to which depth the surface reaches that begins at the nearest of four; 0 where there is none.
HWY_INLINE V limit_of(Four const& depth_m, DepthTolerance tolerance) {
  V const least = hn::Min(hn::Min(depth_m[0], depth_m[1]), hn::Min(depth_m[2], depth_m[3]));
  V const reach =
      least + (constant(tolerance.jump_m) + constant(tolerance.noise_per_m) * least * least);
  return hn::IfThenElseZero(least < constant(kDeepest),
                            hn::Min(reach, constant(0.999F * kDeepest)));
}

/// Mean inverse depth of the surface that reaches to a depth.
HWY_INLINE V surface_w(Four const& depth_m, V limit_m) {
  Four w;
  std::array<M, 4> member;
  for (std::size_t i = 0; i < 4; ++i) {
    w[i] = constant(1.0F) / depth_m[i];
    member[i] = depth_m[i] <= limit_m;
  }
  return mean_of(w, member);
}

void make_blocks_lanes(PixelRows const& pixels, std::size_t count, DepthTolerance tolerance,
                       float* near_w) {
  D const d;
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    Four const z = load_blocks(pixels, u);
    hn::StoreU(surface_w(z, limit_of(z, tolerance)), d, near_w + u);
  }
}

void split_blocks_lanes(PixelRows const& pixels, std::size_t count, DepthTolerance tolerance,
                        SplitRow const& out) {
  D const d;
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    Four z = load_blocks(pixels, u);
    V const near_limit = limit_of(z, tolerance);
    for (V& depth : z) {
      depth = hn::IfThenElse(depth <= near_limit, constant(kDeepest), depth);
    }
    V const far_limit = limit_of(z, tolerance);
    bool const none = hn::AllFalse(d, far_limit > hn::Zero(d));
    hn::StoreU(near_limit, d, out.near_limit_m + u);
    hn::StoreU(far_limit, d, out.far_limit_m + u);
    hn::StoreU(none ? constant(kNothing) : surface_w(z, far_limit), d, out.far_w + u);
  }
}

void merge_blocks_lanes(float const* top, float const* bottom, int left, int right,
                        std::size_t count, DepthTolerance tolerance, float* out) {
  D const d;
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    auto const i = static_cast<std::ptrdiff_t>(u);
    std::array<V, 4> const w = {hn::LoadU(d, top + i + left), hn::LoadU(d, top + i + right),
                                hn::LoadU(d, bottom + i + left), hn::LoadU(d, bottom + i + right)};
    V const nearest = hn::Max(hn::Max(w[0], w[1]), hn::Max(w[2], w[3]));
    V const least = hn::Max(nearest - tolerance_at(nearest, tolerance), hn::Zero(d));
    V const mean = mean_of(w, {w[0] >= least, w[1] >= least, w[2] >= least, w[3] >= least});
    hn::StoreU(mean, d, out + u);
  }
}

void spread_normals_lanes(float const* depth_m, SplitRow const& blocks, ConstVectorRow const& near,
                          ConstVectorRow const& far, std::size_t count, VectorRow const& out) {
  D const d;
  V const nan = constant(std::numeric_limits<float>::quiet_NaN());
  V const shallowest = constant(kShallowest);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    V even;
    V odd;
    hn::LoadInterleaved2(d, depth_m + 2 * u, even, odd);
    V const near_limit = hn::LoadU(d, blocks.near_limit_m + u);
    V const far_limit = hn::LoadU(d, blocks.far_limit_m + u);
    M const even_near = hn::And(even >= shallowest, even <= near_limit);
    M const odd_near = hn::And(odd >= shallowest, odd <= near_limit);
    M const even_far = hn::And(even > near_limit, even <= far_limit);
    M const odd_far = hn::And(odd > near_limit, odd <= far_limit);
    for (std::size_t c = 0; c < out.size(); ++c) {
      V const n = hn::LoadU(d, near[c] + u);
      V const f = hn::LoadU(d, far[c] + u);
      V const of_even = hn::IfThenElse(even_near, n, hn::IfThenElse(even_far, f, nan));
      V const of_odd = hn::IfThenElse(odd_near, n, hn::IfThenElse(odd_far, f, nan));
      hn::StoreInterleaved2(of_even, of_odd, d, out[c] + 2 * u);
    }
  }
}

}  // namespace credo::normals::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::normals {

HWY_EXPORT(make_blocks_lanes);
HWY_EXPORT(split_blocks_lanes);
HWY_EXPORT(merge_blocks_lanes);
HWY_EXPORT(spread_normals_lanes);

void make_blocks(PixelRows const& pixels, std::size_t count, DepthTolerance tolerance,
                 float* near_w) {
  HWY_DYNAMIC_DISPATCH(make_blocks_lanes)(pixels, count, tolerance, near_w);
}

void split_blocks(PixelRows const& pixels, std::size_t count, DepthTolerance tolerance,
                  SplitRow const& out) {
  HWY_DYNAMIC_DISPATCH(split_blocks_lanes)(pixels, count, tolerance, out);
}

void merge_blocks(float const* top, float const* bottom, int left, int right, std::size_t count,
                  DepthTolerance tolerance, float* out) {
  HWY_DYNAMIC_DISPATCH(merge_blocks_lanes)(top, bottom, left, right, count, tolerance, out);
}

void spread_normals(float const* depth_m, SplitRow const& blocks, ConstVectorRow const& near,
                    ConstVectorRow const& far, std::size_t count, VectorRow const& out) {
  HWY_DYNAMIC_DISPATCH(spread_normals_lanes)(depth_m, blocks, near, far, count, out);
}

}  // namespace credo::normals
#endif
