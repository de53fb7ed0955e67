#include "geometry/cell_sums.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/cloud.hpp"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/cell_sums.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/mask_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using lanes::HWY_NAMESPACE::bits_of;

using Floats = hn::CappedTag<float, CellSums::kLanes>;
using Ints = hn::RebindToSigned<Floats>;
using Vec = hn::Vec<Floats>;

// Position along an axis.
HWY_INLINE hn::Vec<Ints> cells_along_axis(Vec coordinate_m, float cells_per_m) {
  Floats const d;
  Vec const cell = hn::Floor(hn::Mul(coordinate_m, hn::Set(d, cells_per_m)));
  Vec const inside =
      hn::Min(hn::Max(cell, hn::Set(d, CellSums::kFirstCell)), hn::Set(d, CellSums::kLastCell));
  return hn::ConvertTo(Ints(), inside);
}

HWY_INLINE Vec moved(std::array<Vec, 3> const& point, std::array<float, 4> const& row) {
  Floats const d;
  Vec const turned = hn::Add(
      hn::Mul(point[0], hn::Set(d, row[0])),
      hn::Add(hn::Mul(point[1], hn::Set(d, row[1])), hn::Mul(point[2], hn::Set(d, row[2]))));
  return hn::Add(turned, hn::Set(d, row[3]));
}

// v - v is 0 where v is finite, else NaN.
HWY_INLINE Vec zero_or_nan(std::array<Vec, 3> const& point) {
  return hn::Add(hn::Sub(point[0], point[0]),
                 hn::Add(hn::Sub(point[1], point[1]), hn::Sub(point[2], point[2])));
}

// As many of `count` values as a vector holds; NaN where there are fewer.
HWY_INLINE Vec some_of(float const* values, std::size_t count) {
  Floats const d;
  if (count >= hn::Lanes(d)) {
    return hn::LoadU(d, values);
  }
  std::array<float, CellSums::kLanes> some;
  for (std::size_t i = 0; i < some.size(); ++i) {
    some[i] = i < count ? values[i] : kNaN;
  }
  return hn::LoadU(d, some.data());
}

// 1 for each point from number i on, as many as a vector holds, whose cell is not that of the point
// before it.
HWY_INLINE std::uint64_t begins_at(CellSums::Chunk const& chunk, std::size_t i) {
  Ints const d;
  auto differences = hn::Zero(d);
  for (auto const& cells : chunk.cells) {
    auto const before = hn::LoadU(d, cells.data() + i);
    differences = hn::Or(differences, hn::Xor(hn::LoadU(d, cells.data() + i + 1), before));
  }
  return bits_of(d, hn::Ne(differences, hn::Zero(d)));
}

// Moves points, finds their cells (kNoCell where a coordinate is not finite) and where these begin,
// and widens the bounds.
void place(PointSpans const& points, CellSums::Placement& placement, CellSums::Chunk& chunk) {
  Floats const d;
  Ints const di;
  std::array<Vec, 3> min;
  std::array<Vec, 3> max;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis] = hn::LoadU(d, placement.min[axis].data());
    max[axis] = hn::LoadU(d, placement.max[axis].data());
  }
  std::size_t const count = points.x.size();
  // The last vector reaches back over points that have their places already.
  std::size_t const last = count - std::min(count, hn::Lanes(d));
  for (std::size_t begin = 0; begin < count; begin += hn::Lanes(d)) {
    std::size_t const i = std::min(begin, last);
    std::array<Vec, 3> point = {some_of(points.x.data() + i, count - i),
                                some_of(points.y.data() + i, count - i),
                                some_of(points.z.data() + i, count - i)};
    if (placement.moves) {
      point = {moved(point, placement.motion[0]), moved(point, placement.motion[1]),
               moved(point, placement.motion[2])};
    }
    auto const finite = hn::Eq(zero_or_nan(point), hn::Zero(d));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto const cell = cells_along_axis(point[axis], placement.cells_per_m);
      hn::StoreU(hn::IfThenElse(hn::RebindMask(di, finite), cell, hn::Set(di, CellSums::kNoCell)),
                 di, chunk.cells[axis].data() + 1 + i);
      hn::StoreU(point[axis], d, chunk.points[axis].data() + i);
      min[axis] = hn::Min(min[axis], hn::IfThenElse(finite, point[axis], min[axis]));
      max[axis] = hn::Max(max[axis], hn::IfThenElse(finite, point[axis], max[axis]));
    }
  }
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    chunk.begins |= begins_at(chunk, i) << i;
  }
  chunk.begins |= 1U;
  if (count < CellSums::kChunk) {
    chunk.begins &= (std::uint64_t{1} << count) - 1;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::StoreU(min[axis], d, placement.min[axis].data());
    hn::StoreU(max[axis], d, placement.max[axis].data());
  }
}

}  // namespace credo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo {

HWY_EXPORT(place);

namespace {

/// A cell in one number, 21 bits an axis.
std::uint64_t key_of(std::int32_t x, std::int32_t y, std::int32_t z) {
  constexpr std::int32_t kHalfRange = 1 << 20;
  auto const bits = [](std::int32_t cell) { return static_cast<std::uint64_t>(cell + kHalfRange); };
  return (bits(x) << 42U) | (bits(y) << 21U) | bits(z);
}

}  // namespace

CellSums::CellSums(float spacing_m) {
  if (!(spacing_m > 0.0F) || !std::isfinite(spacing_m)) {
    throw std::logic_error("thinning: spacing_m is " + std::to_string(spacing_m));
  }
  constexpr float kInf = std::numeric_limits<float>::infinity();
  placement_.cells_per_m = 1.0F / spacing_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    placement_.min[axis].fill(kInf);
    placement_.max[axis].fill(-kInf);
  }
}

CellSums::CellSums(float spacing_m, Se3 const& T_grid_points) : CellSums(spacing_m) {
  Eigen::Matrix4f const matrix = T_grid_points.matrix().cast<float>();
  placement_.moves = true;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) {
      placement_.motion[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          matrix(row, column);
    }
  }
}

// The slot of a cell, or the free one where it belongs. Open addressing with linear probing:
// successive points mostly fall into the same few cells, so that they stay in cache.
std::size_t CellSums::slot_of(std::uint64_t key) const {
  // Fibonacci hashing: the upper bits of the product depend on all bits of the key.
  std::size_t slot =
      (key * 0x9E3779B97F4A7C15U) >> (64U - static_cast<unsigned>(std::countr_zero(slots_.size())));
  while (slots_[slot] != 0 && cells_[slots_[slot]].key != key) {
    slot = (slot + 1) & (slots_.size() - 1);
  }
  return slot;
}

std::uint32_t CellSums::number_of(std::uint64_t key) {
  std::uint32_t& slot = slots_[slot_of(key)];
  if (slot != 0) {
    return slot;
  }
  auto const number = static_cast<std::uint32_t>(cells_.size());
  cells_.emplace_back().key = key;
  slot = number;
  if (4 * cell_count() > slots_.size()) {
    grow();
  }
  return number;
}

void CellSums::grow() {
  slots_.assign(4 * slots_.size(), 0);
  for (std::size_t i = 1; i < cells_.size(); ++i) {
    slots_[slot_of(cells_[i].key)] = static_cast<std::uint32_t>(i);
  }
}

void CellSums::add_chunk(PointSpans const& points) {
  Chunk chunk;
  HWY_DYNAMIC_DISPATCH(place)(points, placement_, chunk);
  auto const& [x, y, z] = chunk.points;
  auto const& [cell_x, cell_y, cell_z] = chunk.cells;
  // Neighbours in the image mostly share their cell: it is looked up once for all of them.
  std::array<std::uint32_t, kChunk> numbers;
  std::size_t runs = 0;
  for (std::uint64_t begins = chunk.begins; begins != 0; begins &= begins - 1) {
    std::size_t const i = 1 + static_cast<std::size_t>(std::countr_zero(begins));
    numbers[runs++] = cell_x[i] == kNoCell ? 0 : number_of(key_of(cell_x[i], cell_y[i], cell_z[i]));
  }
  // Point by point: how many follow each other in one cell is not to be foreseen.
  std::size_t run = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    run += (chunk.begins >> i) & 1U;
    Cell& cell = cells_[numbers[run - 1]];
    cell.sum[0] += static_cast<double>(x[i]);
    cell.sum[1] += static_cast<double>(y[i]);
    cell.sum[2] += static_cast<double>(z[i]);
    cell.count += 1.0;
  }
}

void CellSums::add(PointSpans const& points) {
  for (std::size_t begin = 0; begin < points.x.size(); begin += kChunk) {
    std::size_t const count = std::min(kChunk, points.x.size() - begin);
    add_chunk({points.x.subspan(begin, count), points.y.subspan(begin, count),
               points.z.subspan(begin, count)});
  }
}

void CellSums::add(std::span<Eigen::Vector3f const> points) {
  std::array<std::array<float, kChunk>, 3> axes;
  auto& [x, y, z] = axes;
  for (std::size_t begin = 0; begin < points.size(); begin += kChunk) {
    std::size_t const count = std::min(kChunk, points.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3f const& point = points[begin + i];
      x[i] = point.x();
      y[i] = point.y();
      z[i] = point.z();
    }
    add_chunk({{x.data(), count}, {y.data(), count}, {z.data(), count}});
  }
}

Eigen::Vector3f CellSums::Cell::mean() const {
  return (Eigen::Vector3d(sum[0], sum[1], sum[2]) / count).cast<float>();
}

void CellSums::append_means(std::size_t first, PointList& means) const {
  means.reserve(means.size() + cell_count() - first);
  for (std::size_t i = first + 1; i < cells_.size(); ++i) {
    means.push_back(cells_[i].mean());
  }
}

Eigen::Vector3f CellSums::mean() const {
  Cell all;
  for (std::size_t i = 1; i < cells_.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.sum[axis] += cells_[i].sum[axis];
    }
    all.count += cells_[i].count;
  }
  return all.mean();
}

Eigen::AlignedBox3f CellSums::bounds() const {
  Eigen::AlignedBox3f bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto const i = static_cast<Eigen::Index>(axis);
    bounds.min()[i] = std::ranges::min(placement_.min[axis]);
    bounds.max()[i] = std::ranges::max(placement_.max[axis]);
  }
  return cell_count() == 0 ? Eigen::AlignedBox3f() : bounds;
}

}  // namespace credo
#endif
