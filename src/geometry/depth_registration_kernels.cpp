#include "geometry/depth_registration_kernels.hpp"

#include <algorithm>

#include "core/cloud.hpp"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/depth_registration_kernels.cpp"  // NOLINT(*-macro-usage)
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::depth_registration::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using Ints = hn::Rebind<std::int32_t, D>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

/// A coordinate of z * turn * (u, v, 1) + shift.
HWY_INLINE V warped(Warp const& warp, Eigen::Index axis, V z, V u, float v) {
  D const d;
  float const start = warp.turn(axis, 1) * v + warp.turn(axis, 2);
  V const ray = hn::Add(hn::Mul(hn::Set(d, warp.turn(axis, 0)), u), hn::Set(d, start));
  return hn::Add(hn::Mul(z, ray), hn::Set(d, warp.shift[axis]));
}

void project_lanes(std::size_t width, float v, Warp const& warp, ProjectedRow& row) {
  D const d;
  V const none = hn::Set(d, kNaN);
  V const zero = hn::Zero(d);
  for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
    V const u = hn::Iota(d, static_cast<float>(i));
    V const z = hn::LoadU(d, row.z_m.data() + 1 + i);
    V const depth = warped(warp, 2, z, u, v);
    // The difference is NaN for infinity.
    M const valid =
        hn::And(hn::And(hn::Gt(z, zero), hn::Gt(depth, zero)), hn::Eq(hn::Sub(depth, depth), zero));
    auto const store = [&](V value, std::vector<float>& to) {
      hn::StoreU(hn::IfThenElse(valid, value, none), d, to.data() + 1 + i);
    };
    store(z, row.z_m);
    store(hn::Div(warped(warp, 0, z, u, v), depth), row.u_px);
    store(hn::Div(warped(warp, 1, z, u, v), depth), row.v_px);
    store(depth, row.depth_m);
  }
}

/// The first pixel whose centre is not before the position, between 0 and the size; 0 for NaN.
HWY_INLINE hn::Vec<Ints> first_pixel(V position_px, float size_px) {
  D const d;
  V const inside = hn::IfThenElseZero(hn::Gt(position_px, hn::Zero(d)), position_px);
  return hn::ConvertTo(Ints(), hn::Ceil(hn::Min(inside, hn::Set(d, size_px))));
}

/// Where footprints end along an axis, towards the neighbour in front or behind.
struct Edge {
  V position_px, z_m, half_px;

  [[nodiscard]] HWY_INLINE V towards(float const* neighbour_px, float const* neighbour_z_m) const {
    D const d;
    V const jump_m = hn::Abs(hn::Sub(z_m, hn::LoadU(d, neighbour_z_m)));
    M const same_surface = hn::Le(jump_m, hn::Mul(hn::Set(d, kSameSurface), z_m));
    V const middle = hn::Mul(hn::Set(d, 0.5F), hn::Add(position_px, hn::LoadU(d, neighbour_px)));
    return hn::IfThenElse(same_surface, middle, hn::Add(position_px, half_px));
  }
};

void footprint_lanes(ProjectedRow const& above, ProjectedRow const& row, ProjectedRow const& below,
                     Warp const& warp, Eigen::Array2f const& size_px, Footprints& footprints) {
  D const d;
  auto const store = [](V begin_px, V end_px, float corner_px, float most_px, std::int32_t* first,
                        std::int32_t* count) {
    V const corner = hn::Set(D(), corner_px);
    auto const begin = first_pixel(hn::Sub(begin_px, corner), most_px);
    auto const end = first_pixel(hn::Add(end_px, corner), most_px);
    hn::StoreU(begin, Ints(), first);
    // Seen from behind, a surface has its sides swapped.
    hn::StoreU(hn::Max(hn::Sub(end, begin), hn::Zero(Ints())), Ints(), count);
  };
  Eigen::Array2f const corner = warp.corner_px;
  for (std::size_t i = 0; i < footprints.u.size(); i += hn::Lanes(d)) {
    std::size_t const at = i + 1;
    V const z = hn::LoadU(d, row.z_m.data() + at);
    V const zoom = hn::Div(z, hn::LoadU(d, row.depth_m.data() + at));
    V const half_u = hn::Mul(hn::Set(d, warp.half_px.x()), zoom);
    V const half_v = hn::Mul(hn::Set(d, warp.half_px.y()), zoom);
    V const u = hn::LoadU(d, row.u_px.data() + at);
    V const v = hn::LoadU(d, row.v_px.data() + at);
    V const left = Edge{u, z, hn::Neg(half_u)}.towards(&row.u_px[i], &row.z_m[i]);
    V const right = Edge{u, z, half_u}.towards(&row.u_px[i + 2], &row.z_m[i + 2]);
    V const top = Edge{v, z, hn::Neg(half_v)}.towards(&above.v_px[at], &above.z_m[at]);
    V const bottom = Edge{v, z, half_v}.towards(&below.v_px[at], &below.z_m[at]);
    store(left, right, corner.x(), size_px.x(), &footprints.u[i], &footprints.columns[i]);
    store(top, bottom, corner.y(), size_px.y(), &footprints.v[i], &footprints.rows[i]);
  }
}

}  // namespace credo::depth_registration::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::depth_registration {

HWY_EXPORT(project_lanes);
HWY_EXPORT(footprint_lanes);

namespace {

constexpr std::size_t kMostLanes = 16;

std::size_t whole_vectors(std::size_t width) {
  return (width + kMostLanes - 1) / kMostLanes * kMostLanes;
}

}  // namespace

ProjectedRow::ProjectedRow(std::size_t width)
    : z_m(whole_vectors(width) + 2, kNaN), u_px(z_m), v_px(z_m), depth_m(z_m) {}

Footprints::Footprints(std::size_t width) : u(whole_vectors(width)), v(u), columns(u), rows(u) {}

void project(std::span<float const> depth_m, int v, Warp const& warp, ProjectedRow& row) {
  std::ranges::copy(depth_m, row.z_m.begin() + 1);
  HWY_DYNAMIC_DISPATCH(project_lanes)(depth_m.size(), static_cast<float>(v), warp, row);
}

void find_footprints(ProjectedRow const& above, ProjectedRow const& row, ProjectedRow const& below,
                     Warp const& warp, Eigen::Array2f const& size_px, Footprints& footprints) {
  HWY_DYNAMIC_DISPATCH(footprint_lanes)(above, row, below, warp, size_px, footprints);
}

}  // namespace credo::depth_registration
#endif
