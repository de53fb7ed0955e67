#include "stages/clustering/firm_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "geometry/reachability_runs.hpp"

namespace credo {
namespace {

constexpr std::size_t kShareOfLargest = 10;

/// Pixels of stuff side by side that hold together.
struct FirmRun {
  int v = 0;
  int begin = 0;
  int end = 0;
};

/// A row of an image, as the loops over it want it.
struct Row {
  float const* depth_m;
  LabelCode const* labels;
};

/// For each i: 1 where pixel i of two rows holds together with its like, else 0. Pixels that are no
/// stuff do as far as they have one label. No branches, so that it vectorises.
void mark_together(Row a, Row b, std::size_t count, std::uint8_t* together) {
  for (std::size_t i = 0; i < count; ++i) {
    float const a_m = a.depth_m[i];
    float const b_m = b.depth_m[i];
    // |1/a - 1/b| without a division.
    int const near = std::abs(a_m - b_m) < kFirm_per_m * (a_m * b_m) ? 1 : 0;
    int const same = a.labels[i] == b.labels[i] ? 1 : 0;
    int const other = a.labels[i] < kFirstStuff ? 1 : 0;
    together[i] = static_cast<std::uint8_t>(same & (near | other));
  }
}

/// The first i in [begin, end) with that value; else end.
int find_byte(std::uint8_t const* bytes, int begin, int end, std::uint8_t value) {
  void const* const found =
      std::memchr(bytes + begin, value, static_cast<std::size_t>(end - begin));
  return found == nullptr ? end : static_cast<int>(static_cast<std::uint8_t const*>(found) - bytes);
}

/// What holds together, as runs in raster order.
class Pieces {
public:
  Pieces(Grid<float> const& depth_m, LabelMap const& labels)
      : depth_m_(depth_m),
        labels_(labels),
        beside_(static_cast<std::size_t>(labels.width())),
        above_(static_cast<std::size_t>(labels.width())) {
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
    int const width = labels_.width();
    Row const here = row(v);
    std::uint8_t* const beside = beside_.data();
    mark_together({here.depth_m + 1, here.labels + 1}, here, static_cast<std::size_t>(width - 1),
                  beside + 1);
    for (int begin = 0; begin < width;) {
      int const end = find_byte(beside, begin + 1, width, 0);
      if (is_stuff(here.labels[begin])) {
        runs_.push_back({v, begin, end});
      }
      begin = end;
    }
  }

  /// Joins the runs of a row, which begin at number `below`, to those of the row before.
  void join_rows(int v, std::size_t above, std::size_t below) {
    if (above == below || below == runs_.size()) {
      return;
    }
    mark_together(row(v), row(v - 1), above_.size(), above_.data());
    std::size_t const above_end = below;
    while (above < above_end && below < runs_.size()) {
      int const begin = std::max(runs_[above].begin, runs_[below].begin);
      int const end = std::min(runs_[above].end, runs_[below].end);
      if (begin < end && find_byte(above_.data(), begin, end, 1) < end) {
        joints_.push_back({static_cast<std::int32_t>(above), static_cast<std::int32_t>(below)});
      }
      // The one that ends first has met all it can.
      (runs_[above].end < runs_[below].end ? above : below) += 1;
    }
  }

  Grid<float> const& depth_m_;
  LabelMap const& labels_;
  std::vector<std::uint8_t> beside_;
  std::vector<std::uint8_t> above_;
  std::vector<FirmRun> runs_;
  std::vector<Joint> joints_;
};

}  // namespace

Grid<std::uint8_t> firm_pixels(Grid<float> const& depth_m, LabelMap const& labels) {
  if (labels.empty()) {
    return {labels.width(), labels.height()};
  }
  Pieces const pieces(depth_m, labels);
  std::vector<FirmRun> const& runs = pieces.runs();
  std::vector<std::size_t> const sizes_px = pieces.sizes_px();
  auto const stuff_of = [&](FirmRun const& run) {
    return labels[{run.begin, run.v}] - std::size_t{kFirstStuff};
  };
  std::vector<std::size_t> largest_px(kMaxStuff, 0);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::size_t& most_px = largest_px[stuff_of(runs[i])];
    most_px = std::max(most_px, sizes_px[i]);
  }
  Grid<std::uint8_t> firm(labels.width(), labels.height());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (kShareOfLargest * sizes_px[i] >= largest_px[stuff_of(runs[i])]) {
      std::fill_n(firm.row(runs[i].v).begin() + runs[i].begin, runs[i].end - runs[i].begin,
                  std::uint8_t{1});
    }
  }
  return firm;
}

}  // namespace credo
