#include "stages/segments/labels.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace credo::segments {
namespace {

/// Of a PaddedGrid: offset from its pixel (0, 0).
using Position = std::ptrdiff_t;

class Growth {
public:
  Growth(SurfaceMap const& map, Limits const& limits)
      : map_(map),
        limits_(limits),
        labels_(map.width(), map.height()),
        open_(map.width(), map.height()),
        neighbours_({-1, 1, -labels_.stride(), labels_.stride()}) {
    for (int v = 0; v < map.height(); ++v) {
      std::fill_n(labels_.row(v), map.width(), 0);
    }
  }

  PartLabels parts() && {
    constexpr std::uint8_t kThickest = 4;
    open_where_thick(kThickest);
    begin_parts(limits_.seed_px);
    for (std::uint8_t level = kThickest - 1; level >= 1; --level) {
      open_where_thick(level);
      grow();
      begin_parts(limits_.part_px);
    }
    open_where_valid();
    flood(true);
    flood(false);
    return std::move(labels_);
  }

private:
  /// 1 where a pixel may be labelled in this step and is not yet.
  void open_where_thick(std::uint8_t level) {
    open_rows([&](int v, int u) { return map_.thickness.row(v)[u] >= level; });
  }
  void open_where_valid() {
    open_rows([&](int v, int u) { return map_.disparity.row(v)[u] > 0; });
  }
  template <typename May>
  void open_rows(May const& may) {
    for (int v = 0; v < map_.height(); ++v) {
      std::int32_t const* const labels = labels_.row(v);
      std::uint8_t* const open = open_.row(v);
      for (int u = 0; u < map_.width(); ++u) {
        open[u] = static_cast<std::uint8_t>(static_cast<int>(may(v, u)) &
                                            static_cast<int>(labels[u] == 0));
      }
    }
  }

  /// Calls `visit` with every open pixel, in raster order, eight at a time where there is none.
  template <typename Visit>
  void for_each_open(Visit const& visit) {
    for (int v = 0; v < map_.height(); ++v) {
      std::uint8_t const* const row = open_.row(v);
      for (int u = 0; u < map_.width(); u += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, row + u, sizeof eight);
        for (int i = u; eight != 0 && i < std::min(u + 8, map_.width()); ++i) {
          if (row[i] != 0) {
            visit(row + i - open_.row(0));
          }
        }
      }
    }
  }

  /// Connected open pixels become a part of their own where they are so many.
  void begin_parts(std::uint32_t least_px) {
    std::uint8_t* const open = open_.row(0);
    for_each_open([&](Position start) {
      part_.assign(1, start);
      open[start] = 0;
      for (std::size_t i = 0; i < part_.size(); ++i) {
        Position const at = part_[i];
        for (Position const step : neighbours_) {
          if (open[at + step] != 0) {
            open[at + step] = 0;
            part_.push_back(at + step);
          }
        }
      }
      if (part_.size() >= least_px) {
        for (Position const at : part_) {
          labels_.row(0)[at] = next_;
        }
        ++next_;
      }
    });
  }

  /// Labelled pixels beside open ones, in raster order.
  template <typename Visit>
  void for_each_front(Visit const& visit) {
    std::uint8_t const* const open = open_.row(0);
    for (int v = 0; v < map_.height(); ++v) {
      std::int32_t const* const labels = labels_.row(v);
      Position const row = v * labels_.stride();
      for (int u = 0; u < map_.width(); u += 8) {
        Position const at = row + u;
        if (nothing_open_around(open + at)) {
          continue;
        }
        for (int i = u; i < std::min(u + 8, map_.width()); ++i) {
          Position const p = row + i;
          if (labels[i] != 0 && (open[p - 1] | open[p + 1] | open[p - labels_.stride()] |
                                 open[p + labels_.stride()]) != 0) {
            visit(p);
          }
        }
      }
    }
  }
  /// Of eight pixels.
  [[nodiscard]] bool nothing_open_around(std::uint8_t const* at) const {
    std::uint64_t any = 0;
    for (Position const offset : {Position{-1}, Position{1}, -labels_.stride(), labels_.stride()}) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, at + offset, sizeof eight);
      any |= eight;
    }
    return any == 0;
  }

  void grow() {
    std::uint8_t* const open = open_.row(0);
    std::int32_t* const labels = labels_.row(0);
    part_.clear();
    for_each_front([&](Position at) { part_.push_back(at); });
    for (std::size_t i = 0; i < part_.size(); ++i) {
      Position const at = part_[i];
      for (Position const step : neighbours_) {
        if (open[at + step] != 0) {
          open[at + step] = 0;
          labels[at + step] = labels[at];
          part_.push_back(at + step);
        }
      }
    }
  }

  void flood(bool along_surfaces) {
    std::uint8_t* const open = open_.row(0);
    std::int32_t* const labels = labels_.row(0);
    std::int16_t const* const disparity = map_.disparity.row(0);
    std::int16_t const* const concavity = map_.concavity.row(0);
    std::array<std::vector<Position>, kBuckets> buckets;
    for_each_front([&](Position at) { buckets[0].push_back(at); });
    for (std::size_t key = 0; key < kBuckets; ++key) {
      for (std::size_t i = 0; i < buckets.at(key).size(); ++i) {
        Position const at = buckets.at(key)[i];
        for (Position const step : neighbours_) {
          Position const next = at + step;
          if (open[next] == 0 ||
              (along_surfaces && !linked(disparity[at], disparity[next], limits_.link))) {
            continue;
          }
          open[next] = 0;
          labels[next] = labels[at];
          auto const own = static_cast<std::size_t>(concavity[next] * 2 / kUnitsPerQuantum);
          buckets.at(std::max(key, std::min(own, kBuckets - 1))).push_back(next);
        }
      }
    }
  }

  static constexpr std::size_t kBuckets = 64;

  SurfaceMap const& map_;
  Limits const& limits_;
  PartLabels labels_;
  PaddedGrid<std::uint8_t> open_;
  std::array<Position, 4> neighbours_;
  std::int32_t next_ = 1;
  std::vector<Position> part_;
};

}  // namespace

PartLabels grow_parts(SurfaceMap const& map, Limits const& limits) {
  return Growth(map, limits).parts();
}

}  // namespace credo::segments
