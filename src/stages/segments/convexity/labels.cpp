#include "stages/segments/convexity/labels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "stages/segments/convexity/kernels.hpp"
#include "stages/segments/row_bits.hpp"

namespace credo::segments {
namespace {

/// Of a PaddedGrid: offset from its pixel (0, 0).
using Position = std::int32_t;

/// What a pixel without a label is worth: 0 where there is no depth, or a label already; else one
/// more than its thickness.
constexpr std::uint8_t kValid = 1;
constexpr std::uint8_t kThickest = 5;
constexpr std::uint8_t kMiddle = 3;
constexpr std::uint8_t kThinnest = 2;

/// A pixel that a part has taken, and the part.
struct Taken {
  Position at;
  std::int32_t label;
};

/// Pixels of one row, side by side, that may all be labelled.
struct Run {
  int v = 0;
  int begin = 0;
  int end = 0;
  /// A run of the same part, never a later one; itself where there is none before.
  std::int32_t parent = 0;
};

class Growth {
public:
  Growth(SurfaceMap const& map, Limits const& limits)
      : map_(map),
        limits_(limits),
        labels_(map.width(), map.height(), PartLabels::kFewMarginRows),
        worth_(map.width(), map.height(), PartLabels::kFewMarginRows),
        costs_(map.width(), map.height(), PartLabels::kFewMarginRows),
        bits_(map.width()),
        neighbours_({-1, 1, static_cast<Position>(-labels_.stride()),
                     static_cast<Position>(labels_.stride())}),
        queue_(new Taken[static_cast<std::size_t>(map.width()) *
                             static_cast<std::size_t>(map.height()) +
                         1]) {
    for (int v = 0; v < map.height(); ++v) {
      std::fill_n(labels_.row(v), map.width(), 0);
      worth_row(map.disparity.row(v), map.thickness.row(v), static_cast<std::size_t>(map.width()),
                worth_.row(v));
      worth_.end_row(v);
    }
  }

  PartLabels parts() && {
    begin_parts(kThickest, limits_.seed_px);
    for (std::uint8_t const least : {kMiddle, kThinnest}) {
      grow(least);
      begin_parts(least, limits_.part_px);
    }
    find_costs();
    flood<true>();
    flood<false>();
    return std::move(labels_);
  }

private:
  std::int32_t root_of(std::int32_t run) {
    auto const at = [&](std::int32_t i) -> std::int32_t& {
      return runs_[static_cast<std::size_t>(i)].parent;
    };
    while (at(run) != run) {
      at(run) = at(at(run));
      run = at(run);
    }
    return run;
  }

  /// The runs of a row, joined with those of the row before, which begin at `above`.
  void add_runs(int v, std::uint8_t least, std::size_t above) {
    int const width = map_.width();
    at_least_bits(worth_.row(v), least, static_cast<std::size_t>(width), bits_.data());
    std::size_t const row_begin = runs_.size();
    for (int u = bits_.next_set(0); u < width; u = bits_.next_set(u)) {
      Run run{v, u, u, static_cast<std::int32_t>(runs_.size())};
      u = bits_.next_clear(u);
      run.end = u;
      runs_.push_back(run);
      for (; above < row_begin && runs_[above].begin < run.end; ++above) {
        if (runs_[above].end > run.begin) {
          std::int32_t const a = root_of(static_cast<std::int32_t>(above));
          std::int32_t const b = root_of(static_cast<std::int32_t>(runs_.size() - 1));
          runs_[static_cast<std::size_t>(std::max(a, b))].parent = std::min(a, b);
        }
        if (runs_[above].end > run.end) {
          break;  // the next run may touch it too
        }
      }
    }
  }

  /// Connected pixels of that worth become a part of their own where they are so many.
  void begin_parts(std::uint8_t least, std::uint32_t least_px) {
    runs_.clear();
    std::size_t above = 0;
    for (int v = 0; v < map_.height(); ++v) {
      std::size_t const begin = runs_.size();
      add_runs(v, least, above);
      above = begin;
    }
    std::vector<std::uint32_t> size_px(runs_.size(), 0);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      size_px[static_cast<std::size_t>(root_of(static_cast<std::int32_t>(i)))] +=
          static_cast<std::uint32_t>(runs_[i].end - runs_[i].begin);
    }
    std::vector<std::int32_t> label_of(runs_.size(), 0);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      auto const root = static_cast<std::size_t>(root_of(static_cast<std::int32_t>(i)));
      if (size_px[root] < least_px) {
        continue;
      }
      if (label_of[root] == 0) {
        label_of[root] = next_++;
      }
      Run const& run = runs_[i];
      std::fill(labels_.row(run.v) + run.begin, labels_.row(run.v) + run.end, label_of[root]);
      std::fill(worth_.row(run.v) + run.begin, worth_.row(run.v) + run.end, std::uint8_t{0});
    }
  }

  /// The first layer: all pixels of that worth, or more, beside a labelled one, with the label of
  /// the first of these. Fills the queue, and returns how many they are. Surfaces go on there: what
  /// has a thickness, and so a label, is beside no jump.
  [[nodiscard]] std::size_t find_front(std::uint8_t least) {
    std::int32_t const* const labels = labels_.row(0);
    Taken* const queue = queue_.get();
    Position const down = neighbours_[3];
    // From the last to the first.
    std::array<Position, 4> const steps = {down, neighbours_[1], neighbours_[0], neighbours_[2]};
    std::size_t end = 0;
    for (int v = 0; v < map_.height(); ++v) {
      front_bits(worth_.row(v), down, least, static_cast<std::size_t>(map_.width()), bits_.data());
      bits_.for_each_set([&](int u) {
        Position const at = v * down + u;
        // Without a branch: which there are is not to be foreseen.
        std::int32_t label = 0;
        for (Position const step : steps) {
          std::int32_t const other = labels[at + step];
          label = other != 0 ? other : label;
        }
        queue[end] = {at, label};
        end += label != 0 ? 1 : 0;
      });
    }
    return end;
  }

  void grow(std::uint8_t least) {
    std::uint8_t* const worth = worth_.row(0);
    std::int32_t* const labels = labels_.row(0);
    Taken* const queue = queue_.get();
    // A member might be one of the bytes that are written, for all that compilers know.
    auto const neighbours = neighbours_;
    std::size_t end = find_front(least);
    for (std::size_t i = 0; i < end; ++i) {
      worth[queue[i].at] = 0;
    }
    for (std::size_t i = 0; i < end; ++i) {
      auto const [at, label] = queue[i];
      labels[at] = label;
      for (Position const step : neighbours) {
        // Without a branch, but in bits, for else compilers make one: which way a front advances
        // is not to be foreseen.
        Position const next = at + step;
        unsigned const is_taken = worth[next] >= least ? 1 : 0;
        worth[next] &= static_cast<std::uint8_t>(is_taken - 1U);
        queue[end] = {next, label};
        end += is_taken;
      }
    }
  }

  /// What a flood looks at, in one byte a pixel: that is what it waits for.
  void find_costs() {
    for (int v = 0; v < map_.height(); ++v) {
      flood_row(worth_.row(v), map_.disparity.row(v), map_.disparity.stride(),
                map_.concavity.row(v), limits_.link, static_cast<std::size_t>(map_.width()),
                costs_.row(v));
      costs_.end_row(v);
    }
  }

  /// The rest, the least concave first; along surfaces, not over what is no link.
  template <bool kAlongSurfaces>
  void flood() {
    std::uint8_t* const worth = worth_.row(0);
    std::uint8_t* const costs = costs_.row(0);
    std::int32_t* const labels = labels_.row(0);
    std::array<std::vector<Position>, kFloodCost> buckets;
    auto const take = [&](Position at, std::int32_t label, std::size_t key) {
      std::size_t const cost = costs[at] & kFloodCost;
      costs[at] &= static_cast<std::uint8_t>(~kFloodCost);
      worth[at] = 0;
      labels[at] = label;
      buckets[std::max(key, cost - 1)].push_back(at);
    };
    std::size_t const front = find_front(kValid);
    for (std::size_t i = 0; i < front; ++i) {
      take(queue_[i].at, queue_[i].label, 0);
    }
    for (std::size_t key = 0; key < buckets.size(); ++key) {
      for (std::size_t i = 0; i < buckets[key].size(); ++i) {
        Position const at = buckets[key][i];
        // All four at once: each by itself would be a branch that is not to be foreseen.
        for (unsigned open = open_neighbours<kAlongSurfaces>(costs + at); open != 0;
             open &= open - 1) {
          take(at + neighbours_[static_cast<std::size_t>(std::countr_zero(open))], labels[at], key);
        }
      }
    }
  }

  /// One bit for each of a pixel's neighbours, set where a flood may go on to it.
  template <bool kAlongSurfaces>
  [[nodiscard]] unsigned open_neighbours(std::uint8_t const* cost) const {
    auto const [left, right, up, down] = neighbours_;
    auto const is_open = [&](Position step, unsigned link) {
      bool const is_linked = !kAlongSurfaces || link != 0;
      return static_cast<unsigned>(is_linked) &
             static_cast<unsigned>((cost[step] & kFloodCost) != 0);
    };
    return is_open(left, cost[left] & kLinkedRight) | is_open(right, *cost & kLinkedRight) << 1U |
           is_open(up, cost[up] & kLinkedDown) << 2U | is_open(down, *cost & kLinkedDown) << 3U;
  }

  SurfaceMap const& map_;
  Limits const& limits_;
  PartLabels labels_;
  PaddedGrid<std::uint8_t> worth_;
  PaddedGrid<std::uint8_t> costs_;
  RowBits bits_;
  /// In the order in which fronts advance.
  std::array<Position, 4> neighbours_;
  std::int32_t next_ = 1;
  std::vector<Run> runs_;
  /// Room for every pixel and one more; not a vector: that would write all of it.
  std::unique_ptr<Taken[]> queue_;
};

}  // namespace

PartLabels grow_parts(SurfaceMap const& map, Limits const& limits) {
  return Growth(map, limits).parts();
}

}  // namespace credo::segments
