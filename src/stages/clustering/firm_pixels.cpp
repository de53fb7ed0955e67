#include "stages/clustering/firm_pixels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/clustering/firm_pixels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "geometry/mask_lanes-inl.hpp"

#include "core/bits.hpp"
#include "geometry/reachability/runs.hpp"

#ifndef CREDO_STAGES_CLUSTERING_FIRM_PIXELS_ONCE
#define CREDO_STAGES_CLUSTERING_FIRM_PIXELS_ONCE
namespace credo::firm {

/// A row of an image, as the loops over it want it.
struct Row {
  float const* depth_m;
  LabelCode const* labels;
};

}  // namespace credo::firm
#endif

HWY_BEFORE_NAMESPACE();
namespace credo::firm::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using lanes::HWY_NAMESPACE::bits_of;

using FirmLanes = hn::CappedTag<float, 16>;

/// Of pixels i and on of two rows, as many as a vector holds.
HWY_INLINE std::uint64_t bits_from(Row a, Row b, std::size_t i) {
  FirmLanes const d;
  hn::RebindToSigned<FirmLanes> const di;
  hn::Rebind<LabelCode, FirmLanes> const codes;
  auto const a_m = hn::LoadU(d, a.depth_m + i);
  auto const b_m = hn::LoadU(d, b.depth_m + i);
  auto const label = hn::PromoteTo(di, hn::LoadU(codes, a.labels + i));
  auto const other = hn::PromoteTo(di, hn::LoadU(codes, b.labels + i));
  // |1/a - 1/b| without a division.
  auto const near =
      hn::Lt(hn::Abs(hn::Sub(a_m, b_m)), hn::Mul(hn::Set(d, kFirm_per_m), hn::Mul(a_m, b_m)));
  auto const no_stuff = hn::Lt(label, hn::Set(di, kFirstStuff));
  auto const together = hn::And(hn::Eq(label, other), hn::Or(hn::RebindMask(di, near), no_stuff));
  return bits_of(di, together);
}

void together_lanes(Row a, Row b, std::size_t words, std::uint64_t* together) {
  FirmLanes const d;
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t bits = 0;
    for (std::size_t lane = 0; lane < kWordBits; lane += hn::Lanes(d)) {
      bits |= bits_from(a, b, w * kWordBits + lane) << lane;
    }
    together[w] = bits;
  }
}

}  // namespace credo::firm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo {
namespace firm {

HWY_EXPORT(together_lanes);

}  // namespace firm

namespace {

using firm::Row;

constexpr std::size_t kShareOfLargest = 10;

/// Pixels of stuff side by side that hold together.
struct FirmRun {
  int v = 0;
  int begin = 0;
  int end = 0;
};

/// For each i bit i: 1 where pixel i of two rows holds together with its like, else 0. Pixels that
/// are no stuff do as far as they have one label. Bits beyond `count` are 0.
void mark_together(Row a, Row b, std::size_t count, std::span<std::uint64_t> together) {
  std::size_t const words = count / kWordBits;
  HWY_DYNAMIC_DISPATCH(firm::together_lanes)(a, b, words, together.data());
  std::size_t const begin = words * kWordBits;
  if (begin == count) {
    return;
  }
  // What is left, in a word of its own: nothing is read beyond the row.
  std::array<std::array<float, kWordBits>, 2> depth_m{};
  std::array<std::array<LabelCode, kWordBits>, 2> labels{};
  std::copy(a.depth_m + begin, a.depth_m + count, depth_m[0].begin());
  std::copy(b.depth_m + begin, b.depth_m + count, depth_m[1].begin());
  std::copy(a.labels + begin, a.labels + count, labels[0].begin());
  std::copy(b.labels + begin, b.labels + count, labels[1].begin());
  HWY_DYNAMIC_DISPATCH(firm::together_lanes)
  ({depth_m[0].data(), labels[0].data()}, {depth_m[1].data(), labels[1].data()}, 1,
   &together[words]);
  together[words] &= (std::uint64_t{1} << (count - begin)) - 1;
}

/// Whether any bit from `begin` to before `end` is 1.
bool any_of(std::span<std::uint64_t const> bits, int begin, int end) {
  auto const first = static_cast<std::size_t>(begin);
  auto const last = static_cast<std::size_t>(end) - 1;
  std::uint64_t mask = ~std::uint64_t{0} << (first % kWordBits);
  for (std::size_t w = first / kWordBits; w < last / kWordBits; ++w) {
    if ((bits[w] & mask) != 0) {
      return true;
    }
    mask = ~std::uint64_t{0};
  }
  return (bits[last / kWordBits] & mask &
          (~std::uint64_t{0} >> (kWordBits - 1 - last % kWordBits))) != 0;
}

/// What holds together, as runs in raster order.
class Pieces {
public:
  Pieces(Grid<float> const& depth_m, LabelMap const& labels)
      : depth_m_(depth_m),
        labels_(labels),
        beside_((static_cast<std::size_t>(labels.width()) + kWordBits - 1) / kWordBits),
        above_(beside_.size()) {
    std::size_t above = 0;
    for (int v = 0; v < labels.height(); ++v) {
      std::size_t const begin = runs_.size();
      add_runs(v);
      join_rows(v, above, begin);
      above = begin;
    }
  }

  [[nodiscard]] std::vector<FirmRun> const& runs() const { return runs_; }
  /// Of each run, the pixels of the piece it belongs to.
  [[nodiscard]] std::vector<std::size_t> sizes_px() const {
    reachability::DisjointSets sets(runs_.size());
    for (auto const& [a, b] : joints_) {
      sets.unite(a, b);
    }
    std::vector<std::size_t> sizes(runs_.size(), 0);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      sizes[root(sets, i)] += static_cast<std::size_t>(runs_[i].end - runs_[i].begin);
    }
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      sizes[i] = sizes[root(sets, i)];
    }
    return sizes;
  }

private:
  struct Joint {
    std::int32_t a = 0;
    std::int32_t b = 0;
  };

  static std::size_t root(reachability::DisjointSets& sets, std::size_t run) {
    return static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(run)));
  }

  [[nodiscard]] Row row(int v) const { return {depth_m_.row(v).data(), labels_.row(v).data()}; }

  void add_runs(int v) {
    Row const here = row(v);
    auto const last = static_cast<std::size_t>(labels_.width()) - 1;
    mark_together({here.depth_m + 1, here.labels + 1}, here, last, beside_);
    int begin = 0;
    // Nothing holds on to what is behind the last.
    for (std::size_t w = 0; w <= last / kWordBits; ++w) {
      std::uint64_t const inside =
          ~std::uint64_t{0} >> (kWordBits - 1 - std::min(last - w * kWordBits, kWordBits - 1));
      std::uint64_t const together = w * kWordBits < last ? beside_[w] : 0;
      for (std::uint64_t ends = ~together & inside; ends != 0; ends &= ends - 1) {
        int const end = static_cast<int>(w * kWordBits) + std::countr_zero(ends) + 1;
        if (is_stuff(here.labels[begin])) {
          runs_.push_back({v, begin, end});
        }
        begin = end;
      }
    }
  }

  /// Joins the runs of a row, which begin at number `below`, to those of the row before.
  void join_rows(int v, std::size_t above, std::size_t below) {
    if (above == below || below == runs_.size()) {
      return;
    }
    mark_together(row(v), row(v - 1), static_cast<std::size_t>(labels_.width()), above_);
    std::size_t const above_end = below;
    while (above < above_end && below < runs_.size()) {
      int const begin = std::max(runs_[above].begin, runs_[below].begin);
      int const end = std::min(runs_[above].end, runs_[below].end);
      if (begin < end && any_of(above_, begin, end)) {
        joints_.push_back({static_cast<std::int32_t>(above), static_cast<std::int32_t>(below)});
      }
      // The one that ends first has met all it can.
      (runs_[above].end < runs_[below].end ? above : below) += 1;
    }
  }

  Grid<float> const& depth_m_;
  LabelMap const& labels_;
  std::vector<std::uint64_t> beside_;
  std::vector<std::uint64_t> above_;
  std::vector<FirmRun> runs_;
  std::vector<Joint> joints_;
};

}  // namespace

std::vector<StuffRun> firm_runs(Grid<float> const& depth_m, LabelMap const& labels) {
  if (labels.empty()) {
    return {};
  }
  Pieces const pieces(depth_m, labels);
  std::vector<FirmRun> const& runs = pieces.runs();
  std::vector<std::size_t> const sizes_px = pieces.sizes_px();
  std::vector<StuffRun> result(runs.size());
  std::vector<std::size_t> largest_px;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::size_t const row = labels.index({0, runs[i].v});
    result[i].pixels = {row + static_cast<std::size_t>(runs[i].begin),
                        row + static_cast<std::size_t>(runs[i].end)};
    result[i].label = labels[result[i].pixels.begin];
    result[i].piece_px = static_cast<std::uint32_t>(sizes_px[i]);
    std::size_t const number = result[i].label - std::size_t{kFirstStuff};
    if (number >= largest_px.size()) {
      largest_px.resize(number + 1, 0);
    }
    std::size_t& most_px = largest_px[number];
    most_px = std::max(most_px, sizes_px[i]);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    result[i].is_firm =
        kShareOfLargest * sizes_px[i] >= largest_px[result[i].label - std::size_t{kFirstStuff}];
  }
  return result;
}

}  // namespace credo
#endif  // HWY_ONCE
