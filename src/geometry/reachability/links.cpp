#include <algorithm>
#include <limits>

#include "geometry/reachability/kernels.hpp"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/reachability/links.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/reachability/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::reachability::HWY_NAMESPACE {

// x - x is 0 where x is finite, else NaN.
HWY_INLINE Mask finite(Oriented const& a) {
  Vec3 const p = difference(a.point, a.point);
  Vec3 const n = difference(a.normal, a.normal);
  Vec const sum = hn::Add(hn::Add(hn::Add(p.x, p.y), hn::Add(p.z, n.x)), hn::Add(n.y, n.z));
  return hn::Eq(sum, hn::Zero(Floats()));
}

HWY_INLINE Mask active_mask(std::uint8_t const* active) {
  Floats const d;
  hn::Rebind<std::uint8_t, Floats> const bytes;
  hn::RebindToSigned<Floats> const ints;
  auto const values = hn::PromoteTo(ints, hn::LoadU(bytes, active));
  return hn::RebindMask(d, hn::Ne(values, hn::Zero(ints)));
}

HWY_INLINE void put_bits(std::uint64_t* row, std::size_t u, std::uint64_t bits) {
  row[u / 64] |= bits << (u % 64);
  row[u / 64 + 1] |= u % 64 == 0 ? 0 : bits >> (64 - u % 64);
}

HWY_INLINE std::uint64_t get_bits(std::uint64_t const* row, std::size_t u) {
  return row[u / 64] >> (u % 64) | (u % 64 == 0 ? 0 : row[u / 64 + 1] << (64 - u % 64));
}

class SquaredLengths {
public:
  SquaredLengths() : min_(hn::Set(Floats(), 1.0F)), max_(hn::Set(Floats(), 1.0F)) {}
  void add(Vec3 const& normal, Mask usable) {
    include(ordered_dot(normal, normal), usable, min_, max_);
  }
  [[nodiscard]] float min() const { return hn::GetLane(hn::MinOfLanes(Floats(), min_)); }
  [[nodiscard]] float max() const { return hn::GetLane(hn::MaxOfLanes(Floats(), max_)); }

private:
  Vec min_;
  Vec max_;
};

// Bounds of one row of tiles, gathered row by row of pixels while they are at hand anyway.
class TileRowBounds {
public:
  explicit TileRowBounds(std::size_t tiles) : lanes_(tiles * kStride) {}

  void clear() {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < lanes_.size(); i += kStride) {
      std::fill_n(lanes_.data() + i, kStride / 2, kInf);
      std::fill_n(lanes_.data() + i + kStride / 2, kStride / 2, -kInf);
    }
  }
  HWY_INLINE void add(std::size_t tile, Vec3 const& point, Mask usable) {
    LaneBounds bounds = get(tile);
    include(point, usable, bounds);
    Floats const d;
    float* at = lanes_.data() + tile * kStride;
    hn::StoreU(bounds.min.x, d, at);
    hn::StoreU(bounds.min.y, d, at + kTile);
    hn::StoreU(bounds.min.z, d, at + 2 * kTile);
    hn::StoreU(bounds.max.x, d, at + 3 * kTile);
    hn::StoreU(bounds.max.y, d, at + 4 * kTile);
    hn::StoreU(bounds.max.z, d, at + 5 * kTile);
  }
  void store(std::size_t tv, LinkBits& links) const {
    for (std::size_t tu = 0; tu < links.layout.tiles_u; ++tu) {
      links.tiles.set_box(links.layout.tile_at(tu, tv), box_over_lanes(get(tu)));
    }
  }

private:
  static constexpr std::size_t kStride = 6 * kTile;

  [[nodiscard]] HWY_INLINE LaneBounds get(std::size_t tile) const {
    float const* at = lanes_.data() + tile * kStride;
    return {.min = load({at, at + kTile, at + 2 * kTile}, 0),
            .max = load({at + 3 * kTile, at + 4 * kTile, at + 5 * kTile}, 0)};
  }

  std::vector<float> lanes_;
};

class Linker {
public:
  Linker(PointArrays const& points, std::uint8_t const* active, ReachThresholds const& reach)
      : points_(points),
        active_(active),
        reach_(reach),
        width_(static_cast<std::size_t>(points.width)),
        links_(points.width, points.height),
        tile_row_(links_.layout.tiles_u) {}

  LinkBits link() {
    for (int v = 0; v < points_.height; ++v) {
      if (v % kTile == 0) {
        tile_row_.clear();
      }
      link_row(v);
      if ((v + 1) % kTile == 0 || v + 1 == points_.height) {
        tile_row_.store(static_cast<std::size_t>(v / kTile), links_);
      }
    }
    links_.min_squared_normal = lengths_.min();
    links_.max_squared_normal = lengths_.max();
    return std::move(links_);
  }

private:
  // The links of as many pixels as a vector holds, a bit each, not yet masked by what is usable.
  struct Step {
    Vec3 point;
    Mask mask;
    std::uint64_t usable = 0;
    std::uint64_t right = 0;
    std::uint64_t up = 0;
    std::uint64_t rising = 0;
    std::uint64_t falling = 0;
  };

  void link_row(int v) {
    std::size_t const lanes = hn::Lanes(Floats());
    std::size_t u = 0;
    for (; u + lanes < width_; u += lanes) {
      if (none_active(v, u)) {
        continue;
      }
      Step const step = link_at(v, u);
      tile_row_.add(u / kTile, step.point, step.mask);
      // Steps never straddle two words here.
      std::size_t const word = u / 64;
      std::size_t const shift = u % 64;
      links_.usable.row(v)[word] |= step.usable << shift;
      links_.right.row(v)[word] |= step.right << shift;
      links_.up.row(v)[word] |= step.up << shift;
      links_.rising.row(v)[word] |= step.rising << shift;
      links_.falling.row(v)[word] |= step.falling << shift;
    }
    // What is left of the row: one step that overlaps the last one, and the last column, which has
    // no right neighbour.
    put(v, width_ - 1 - lanes, link_at(v, width_ - 1 - lanes));
    Step const step = link_last_column(v);
    put(v, width_ - lanes, step);
    Mask const done = hn::FirstN(Floats(), lanes - (width_ - u));
    tile_row_.add(u / kTile, step.point, hn::AndNot(done, step.mask));
  }

  // None of a step's pixels takes part, nor the one to their right, which ends its falling links.
  [[nodiscard]] HWY_INLINE bool none_active(int v, std::size_t u) const {
    std::uint8_t const* first = active_ + static_cast<std::size_t>(v) * width_ + u;
    return std::all_of(first, first + hn::Lanes(Floats()) + 1,
                       [](std::uint8_t active) { return active == 0; });
  }

  void put(int v, std::size_t u, Step const& step) {
    put_bits(links_.usable.row(v), u, step.usable);
    put_bits(links_.right.row(v), u, step.right);
    put_bits(links_.up.row(v), u, step.up);
    put_bits(links_.rising.row(v), u, step.rising);
    put_bits(links_.falling.row(v), u, step.falling);
  }

  HWY_INLINE Step use(Oriented const& here, std::size_t i) {
    Step step;
    step.point = here.point;
    step.mask = hn::And(finite(here), active_mask(active_ + i));
    step.usable = bits_of(step.mask);
    lengths_.add(here.normal, step.mask);
    return step;
  }

  HWY_INLINE Step link_at(int v, std::size_t u) {
    std::size_t const i = static_cast<std::size_t>(v) * width_ + u;
    Oriented const here = load(points_, i);
    Oriented const right = load(points_, i + 1);
    Step step = use(here, i);
    step.right = bits_of(within_reach(here, right, reach_));
    if (v > 0) {
      Oriented const above = load(points_, i - width_);
      step.up = bits_of(within_reach(here, above, reach_));
      std::uint64_t const all = (std::uint64_t{1} << hn::Lanes(Floats())) - 1;
      std::uint64_t const around = step.usable & step.right & step.up &
                                   get_bits(links_.usable.row(v - 1), u) &
                                   get_bits(links_.right.row(v - 1), u);
      // Inside a surface every diagonal has a way round.
      if ((around & all) != all) {
        Oriented const above_right = load(points_, i - width_ + 1);
        step.rising = bits_of(within_reach(here, above_right, reach_));
        step.falling = bits_of(within_reach(above, right, reach_));
      }
    }
    return step;
  }

  HWY_INLINE Step link_last_column(int v) {
    std::size_t const i = static_cast<std::size_t>(v) * width_ + width_ - hn::Lanes(Floats());
    Oriented const here = load(points_, i);
    Step step = use(here, i);
    if (v > 0) {
      step.up = bits_of(within_reach(here, load(points_, i - width_), reach_));
    }
    return step;
  }

  PointArrays points_;
  std::uint8_t const* active_;
  ReachThresholds reach_;
  std::size_t width_;
  LinkBits links_;
  TileRowBounds tile_row_;
  SquaredLengths lengths_;
};

LinkBits link_neighbours(PointArrays const& points, std::uint8_t const* active,
                         ReachThresholds const& reach) {
  return Linker(points, active, reach).link();
}

}  // namespace credo::reachability::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo::reachability {

HWY_EXPORT(link_neighbours);

LinkBits link_neighbours(PointArrays const& points, std::uint8_t const* active,
                         ReachThresholds const& reach) {
  return HWY_DYNAMIC_DISPATCH(link_neighbours)(points, active, reach);
}

}  // namespace credo::reachability
#endif
