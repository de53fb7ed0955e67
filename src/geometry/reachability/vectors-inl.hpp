// Vectors of points and normals, for the kernels of connected_components. Included once for each
// instruction set, as Highway has it.
#if defined(CREDO_REACHABILITY_VECTORS) == defined(HWY_TARGET_TOGGLE)
#ifdef CREDO_REACHABILITY_VECTORS
#undef CREDO_REACHABILITY_VECTORS
#else
#define CREDO_REACHABILITY_VECTORS
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/mask_lanes-inl.hpp"
#include "geometry/reachability/kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::reachability::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most one row of a tile: masks fit a byte, whatever the width of the machine's vectors.
using Floats = hn::CappedTag<float, kTile>;
using Vec = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

struct Vec3 {
  Vec x, y, z;
};

// The same operations, in the same order, as credo::ordered_dot.
HWY_INLINE Vec ordered_dot(Vec3 const& a, Vec3 const& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}

HWY_INLINE Vec3 difference(Vec3 const& a, Vec3 const& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vec3 broadcast(float x, float y, float z) {
  Floats const d;
  return {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
}

HWY_INLINE Vec3 load(std::array<float const*, 3> const& arrays, std::size_t i) {
  Floats const d;
  return {hn::LoadU(d, arrays[0] + i), hn::LoadU(d, arrays[1] + i), hn::LoadU(d, arrays[2] + i)};
}

struct Oriented {
  Vec3 point, normal;
};

HWY_INLINE Oriented load(PointArrays const& points, std::size_t i) {
  return {load(points.point, i), load(points.normal, i)};
}

// The same as credo::within_reach.
HWY_INLINE Mask within_reach(Oriented const& a, Oriented const& b, ReachThresholds const& reach) {
  Floats const d;
  Vec3 const step = difference(a.point, b.point);
  return hn::And(hn::Le(ordered_dot(step, step), hn::Set(d, reach.max_squared_distance_m2)),
                 hn::Gt(ordered_dot(a.normal, b.normal), hn::Set(d, reach.min_cosine)));
}

HWY_INLINE std::uint64_t bits_of(Mask mask) {
  return lanes::HWY_NAMESPACE::bits_of(Floats(), mask);
}

HWY_INLINE Mask mask_of(std::uint64_t bits) {
  std::array<std::uint8_t, 8> const bytes{static_cast<std::uint8_t>(bits)};
  return hn::LoadMaskBits(Floats(), bytes.data());
}

// Bounds of vectors, lane by lane.
struct LaneBounds {
  Vec3 min, max;
};

HWY_INLINE LaneBounds nothing() {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  return {.min = broadcast(kInf, kInf, kInf), .max = broadcast(-kInf, -kInf, -kInf)};
}

HWY_INLINE void include(Vec value, Mask mask, Vec& min, Vec& max) {
  min = hn::Min(min, hn::IfThenElse(mask, value, min));
  max = hn::Max(max, hn::IfThenElse(mask, value, max));
}

HWY_INLINE void include(Vec3 const& value, Mask mask, LaneBounds& bounds) {
  include(value.x, mask, bounds.min.x, bounds.max.x);
  include(value.y, mask, bounds.min.y, bounds.max.y);
  include(value.z, mask, bounds.min.z, bounds.max.z);
}

HWY_INLINE Box box_over_lanes(LaneBounds const& bounds) {
  Floats const d;
  return {.min = {hn::GetLane(hn::MinOfLanes(d, bounds.min.x)),
                  hn::GetLane(hn::MinOfLanes(d, bounds.min.y)),
                  hn::GetLane(hn::MinOfLanes(d, bounds.min.z))},
          .max = {hn::GetLane(hn::MaxOfLanes(d, bounds.max.x)),
                  hn::GetLane(hn::MaxOfLanes(d, bounds.max.y)),
                  hn::GetLane(hn::MaxOfLanes(d, bounds.max.z))}};
}

}  // namespace credo::reachability::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
