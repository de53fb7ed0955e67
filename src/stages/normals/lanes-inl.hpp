// What the kernels of the normals share, once per instruction set: Highway's per-target guard takes
// the place of #pragma once.
#if defined(CREDO_STAGES_NORMALS_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CREDO_STAGES_NORMALS_LANES_INL_HPP
#undef CREDO_STAGES_NORMALS_LANES_INL_HPP
#else
#define CREDO_STAGES_NORMALS_LANES_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "stages/normals/depth_tolerance.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::normals::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most the 16 lanes that rows are padded to.
using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using DI = hn::RebindToSigned<D>;
using VI = hn::Vec<DI>;

HWY_INLINE V constant(float value) {
  return hn::Set(D(), value);
}

/// The tolerance at an inverse depth, as a difference of inverse depths.
HWY_INLINE V tolerance_at(V w, DepthTolerance tolerance) {
  return constant(tolerance.jump_m) * w * w + constant(tolerance.noise_per_m);
}

}  // namespace credo::normals::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
