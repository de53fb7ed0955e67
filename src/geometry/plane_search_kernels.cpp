#include "geometry/plane_search_kernels.hpp"

#include <algorithm>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/plane_search_kernels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::plane_search::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE V dot(FloatPlane const& plane, V x, V y, V z) {
  D const d;
  return hn::Add(
      hn::Add(hn::Mul(hn::Set(d, plane.normal_x), x), hn::Mul(hn::Set(d, plane.normal_y), y)),
      hn::Mul(hn::Set(d, plane.normal_z), z));
}

/// Of as many points as a vector holds; see belongs().
HWY_INLINE M belonging(FloatPlane const& plane, PlaneSearchPoints const& points, std::size_t i) {
  D const d;
  V const along = dot(plane, hn::LoadU(d, points.x.data() + i), hn::LoadU(d, points.y.data() + i),
                      hn::LoadU(d, points.z.data() + i));
  V const cosine =
      dot(plane, hn::LoadU(d, points.normal_x.data() + i), hn::LoadU(d, points.normal_y.data() + i),
          hn::LoadU(d, points.normal_z.data() + i));
  V const distance = hn::Abs(hn::Sub(along, hn::Set(d, plane.offset_m)));
  M const near = hn::Le(distance, hn::LoadU(d, points.tolerance_m.data() + i));
  M const turned = hn::Lt(hn::Abs(cosine), hn::Set(d, plane.min_cosine));
  return hn::AndNot(turned, near);
}

std::size_t count_lanes(FloatPlane const& plane, PlaneSearchPoints const& points,
                        std::size_t to_beat) {
  D const d;
  // So often it is asked whether the count can still be the largest.
  constexpr std::size_t kStep = 256;
  std::size_t count = 0;
  std::size_t i = 0;
  while (i < points.size() && count + points.size() - i > to_beat) {
    std::size_t const end = std::min(i + kStep, points.size());
    for (; i + hn::Lanes(d) <= end; i += hn::Lanes(d)) {
      count += hn::CountTrue(d, belonging(plane, points, i));
    }
    for (; i < end; ++i) {
      count += belongs(plane, points, i);
    }
  }
  return count;
}

std::size_t mark_lanes(FloatPlane const& plane, PlaneSearchPoints const& points,
                       std::uint8_t* flags) {
  D const d;
  hn::RebindToSigned<D> const words;
  hn::Rebind<std::uint8_t, D> const bytes;
  auto const one = hn::Set(words, 1);
  std::size_t count = 0;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= points.size(); i += hn::Lanes(d)) {
    M const mask = belonging(plane, points, i);
    count += hn::CountTrue(d, mask);
    auto const flag = hn::IfThenElseZero(hn::RebindMask(words, mask), one);
    hn::StoreU(hn::DemoteTo(bytes, flag), bytes, flags + i);
  }
  for (; i < points.size(); ++i) {
    flags[i] = belongs(plane, points, i);
    count += flags[i];
  }
  return count;
}

}  // namespace credo::plane_search::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::plane_search {

HWY_EXPORT(count_lanes);
HWY_EXPORT(mark_lanes);

FloatPlane::FloatPlane(Plane const& plane, double max_angle_rad)
    : normal_x(static_cast<float>(plane.normal.x())),
      normal_y(static_cast<float>(plane.normal.y())),
      normal_z(static_cast<float>(plane.normal.z())),
      offset_m(static_cast<float>(plane.offset_m)),
      // Above a right angle every |cosine| passes.
      min_cosine(max_angle_rad < 1.5707963 ? static_cast<float>(std::cos(max_angle_rad)) : -1.0F) {}

std::size_t count_belonging(FloatPlane const& plane, PlaneSearchPoints const& points,
                            std::size_t to_beat) {
  return HWY_DYNAMIC_DISPATCH(count_lanes)(plane, points, to_beat);
}

std::size_t mark_belonging(FloatPlane const& plane, PlaneSearchPoints const& points,
                           std::span<std::uint8_t> flags) {
  return HWY_DYNAMIC_DISPATCH(mark_lanes)(plane, points, flags.data());
}

}  // namespace credo::plane_search
#endif
