#include "stages/normals/block_kernels.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/normals/block_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "stages/normals/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::normals::HWY_NAMESPACE {

// Depths outside are invalid: no sensor measures them, and their squares would overflow.
constexpr float kShallowest = 1e-3F;
constexpr float kDeepest = 1e6F;

/// Mean of those of four values that are members; kNothing where none is.
V mean_of(std::array<V, 4> const& value, std::array<M, 4> const& member) {
  auto const pick = [&](std::size_t i) { return hn::IfThenElseZero(member[i], value[i]); };
  auto const one = [&](std::size_t i) { return hn::IfThenElseZero(member[i], constant(1.0F)); };
  V const sum = (pick(0) + pick(1)) + (pick(2) + pick(3));
  V const count = (one(0) + one(1)) + (one(2) + one(3));
  return hn::IfThenElse(count > hn::Zero(D()), sum / count, constant(kNothing));
}

/// The mean inverse depth of a surface, and the depth up to which it reaches; kNothing and 0 where
/// there is none.
struct Surface {
  V w;
  V limit_m;
};

/// The surface that begins at the nearest of four depths; kDeepest = invalid.
Surface nearest_surface(std::array<V, 4> const& depth_m, DepthTolerance tolerance) {
  V const least = hn::Min(hn::Min(depth_m[0], depth_m[1]), hn::Min(depth_m[2], depth_m[3]));
  V const reach =
      least + (constant(tolerance.jump_m) + constant(tolerance.noise_per_m) * least * least);
  V const limit =
      hn::IfThenElseZero(least < constant(kDeepest), hn::Min(reach, constant(0.999F * kDeepest)));
  std::array<V, 4> w;
  std::array<M, 4> member;
  for (std::size_t i = 0; i < 4; ++i) {
    w[i] = constant(1.0F) / depth_m[i];
    member[i] = depth_m[i] <= limit;
  }
  return {mean_of(w, member), limit};
}

void make_blocks_lanes(float const* top_m, float const* bottom_m, std::size_t count,
                       DepthTolerance tolerance, BlockRow const& out) {
  D const d;
  V const deepest = constant(kDeepest);
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    std::array<V, 4> z;
    hn::LoadInterleaved2(d, top_m + 2 * u, z[0], z[1]);
    hn::LoadInterleaved2(d, bottom_m + 2 * u, z[2], z[3]);
    for (V& depth : z) {
      M const valid = hn::And(depth >= constant(kShallowest), depth < deepest);
      depth = hn::IfThenElse(valid, depth, deepest);
    }
    Surface const near = nearest_surface(z, tolerance);
    for (V& depth : z) {
      depth = hn::IfThenElse(depth <= near.limit_m, deepest, depth);
    }
    Surface const far = nearest_surface(z, tolerance);
    hn::StoreU(near.w, d, out.near_w + u);
    hn::StoreU(near.limit_m, d, out.near_limit_m + u);
    hn::StoreU(far.w, d, out.far_w + u);
    hn::StoreU(far.limit_m, d, out.far_limit_m + u);
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

void spread_normals_lanes(float const* depth_m, BlockRow const& blocks, ConstVectorRow const& near,
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
HWY_EXPORT(merge_blocks_lanes);
HWY_EXPORT(spread_normals_lanes);

void make_blocks(float const* top_m, float const* bottom_m, std::size_t count,
                 DepthTolerance tolerance, BlockRow const& out) {
  HWY_DYNAMIC_DISPATCH(make_blocks_lanes)(top_m, bottom_m, count, tolerance, out);
}

void merge_blocks(float const* top, float const* bottom, int left, int right, std::size_t count,
                  DepthTolerance tolerance, float* out) {
  HWY_DYNAMIC_DISPATCH(merge_blocks_lanes)(top, bottom, left, right, count, tolerance, out);
}

void spread_normals(float const* depth_m, BlockRow const& blocks, ConstVectorRow const& near,
                    ConstVectorRow const& far, std::size_t count, VectorRow const& out) {
  HWY_DYNAMIC_DISPATCH(spread_normals_lanes)(depth_m, blocks, near, far, count, out);
}

}  // namespace credo::normals
#endif
