#include "stages/segments/raised/relief_kernels.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "stages/segments/raised/relief_kernels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::segments::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;

/// At the places `x`.
HWY_INLINE VF heights_at(VF depth_m, VF x, SurfaceRow const& surface) {
  DF const d;
  VF const quanta = hn::Set(d, surface.at_middle) +
                    x * (hn::Set(d, surface.slope) + x * hn::Set(d, surface.bend));
  VF const over = (hn::Set(d, surface.quanta_m) / depth_m - quanta) * hn::Set(d, surface.share);
  return hn::Max(hn::Set(d, -surface.farthest), hn::Min(over, hn::Set(d, surface.farthest)));
}

void height_row_lanes(float const* depth_m, SurfaceRow const& surface, std::size_t count,
                      float* heights) {
  DF const d;
  VF const first = hn::Set(d, surface.first_x);
  VF const step = hn::Set(d, surface.step_x);
  auto const at = [&](std::size_t i)
                      HWY_ATTR { return first + step * hn::Iota(d, static_cast<float>(i)); };
  alignas(64) std::array<float, 16> rest_m;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    hn::StoreU(heights_at(hn::LoadU(d, depth_m + i), at(i), surface), d, heights + i);
  }
  if (i < count) {
    // What is beyond is as far as 1 m: nothing is divided by 0.
    hn::Store(hn::Set(d, 1.0F), d, rest_m.data());
    std::copy_n(depth_m + i, count - i, rest_m.begin());
    hn::StoreU(heights_at(hn::Load(d, rest_m.data()), at(i), surface), d, heights + i);
  }
}

void sum_row_lanes(float const* values, std::size_t count, float* sums) {
  DF const d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    float const* const at = values + i;
    hn::StoreU(hn::LoadU(d, at - 1) + hn::LoadU(d, at) + hn::LoadU(d, at + 1), d, sums + i);
  }
}

void mean_row_lanes(SumsRow const& above, SumsRow const& here, SumsRow const& below,
                    std::size_t count, float* means) {
  DF const d;
  DI const di;
  for (std::size_t u = 0; u < count; u += hn::Lanes(d)) {
    auto const surface = hn::LoadU(di, here.surface + u);
    auto const same = [&](SumsRow const& other) HWY_ATTR {
      return hn::RebindMask(d, hn::LoadU(di, other.surface + u) == surface);
    };
    auto const up = same(above);
    auto const down = same(below);
    VF const sum = hn::LoadU(d, here.sums + u) +
                   hn::IfThenElseZero(up, hn::LoadU(d, above.sums + u)) +
                   hn::IfThenElseZero(down, hn::LoadU(d, below.sums + u));
    VF const number = hn::LoadU(d, here.counts + u) +
                      hn::IfThenElseZero(up, hn::LoadU(d, above.counts + u)) +
                      hn::IfThenElseZero(down, hn::LoadU(d, below.counts + u));
    auto const any = hn::RebindMask(d, surface != hn::Zero(di));
    hn::StoreU(hn::IfThenElseZero(any, sum / hn::Max(number, hn::Set(d, 1.0F))), d, means + u);
  }
}

}  // namespace credo::segments::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::segments {

HWY_EXPORT(height_row_lanes);
HWY_EXPORT(sum_row_lanes);
HWY_EXPORT(mean_row_lanes);

void height_row(float const* depth_m, SurfaceRow const& surface, std::size_t count,
                float* heights) {
  HWY_DYNAMIC_DISPATCH(height_row_lanes)(depth_m, surface, count, heights);
}

void sum_row(float const* values, std::size_t count, float* sums) {
  HWY_DYNAMIC_DISPATCH(sum_row_lanes)(values, count, sums);
}

void mean_row(SumsRow const& above, SumsRow const& here, SumsRow const& below, std::size_t count,
              float* means) {
  HWY_DYNAMIC_DISPATCH(mean_row_lanes)(above, here, below, count, means);
}

}  // namespace credo::segments
#endif
