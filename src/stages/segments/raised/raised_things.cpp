#include "stages/segments/raised/raised_things.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "core/runs.hpp"
#include "stages/segments/convexity/kernels.hpp"
#include "stages/segments/raised/relief.hpp"
#include "stages/segments/row_bits.hpp"

namespace credo {
namespace {

using segments::PaddedGrid;
using segments::RowBits;

/// What is around a thing is the surface, but for this part; a rim, which has next to nothing of it
/// on one side, is a part of what it is the rim of. At the reference focal length.
constexpr double kBeside = 0.4;
constexpr double kRim_px = 8.0;
/// Levels at which pieces are looked for, the lower the better; where the surface itself is bent
/// more than that, the next.
constexpr std::array<float, 4> kLevels = {0.5F, 0.75F, 1.0F, 1.5F};
/// A thing has an edge; what a sensor bends has none. Sensors blur edges: of what is half as high
/// again as it must be, they are looked for over more pixels, too (at the reference focal length).
constexpr double kLeastStep = 1.0;
/// Of a piece that comes apart at half its height, as pixels of the largest part: what is less than
/// that is no thing of its own.
constexpr double kLeastOfLargest = 0.2;
constexpr float kClearlyHigh = 1.5F;
constexpr int kAway_px = 2;
constexpr double kBlurred_px = 5.0;

/// Pixels of a row, side by side, of one segment, that stand out; as many as there are.
struct Run {
  int v = 0;
  int begin = 0;
  int end = 0;
  std::int32_t label = 0;
};
/// From the top, and from the left.
using Runs = std::vector<Run>;

/// Calls `visit(run, first, last)` for each run with those, from the first to before the last, that
/// share columns with it in the row that is `rows_below`.
template <typename Visit>
void for_each_with_next(Runs const& runs, int rows_below, Visit const& visit) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Run const& run = runs[i];
    int const v = run.v + rows_below;
    while (first < runs.size() &&
           (runs[first].v < v || (runs[first].v == v && runs[first].end <= run.begin))) {
      ++first;
    }
    std::size_t last = first;
    while (last < runs.size() && runs[last].v == v && runs[last].begin < run.end) {
      ++last;
    }
    visit(i, first, last);
  }
}

/// Of each run the first one that it is connected with.
std::vector<std::size_t> first_of_each(Runs const& runs) {
  std::vector<std::size_t> parents(runs.size());
  auto const root_of = [&](std::size_t i) {
    while (parents[i] != i) {
      parents[i] = parents[parents[i]];
      i = parents[i];
    }
    return i;
  };
  for_each_with_next(runs, -1, [&](std::size_t run, std::size_t first, std::size_t last) {
    parents[run] = run;
    for (std::size_t i = first; i < last; ++i) {
      if (runs[i].label == runs[run].label) {
        std::size_t const a = root_of(i);
        std::size_t const b = root_of(run);
        parents[std::max(a, b)] = std::min(a, b);
      }
    }
  });
  for (std::size_t i = 0; i < runs.size(); ++i) {
    parents[i] = root_of(i);
  }
  return parents;
}

std::size_t pixels_of(Runs const& runs) {
  std::size_t pixels = 0;
  for (Run const& run : runs) {
    pixels += static_cast<std::size_t>(run.end - run.begin);
  }
  return pixels;
}

class RaisedFinder {
public:
  /// `scale` is that of lengths in pixels.
  RaisedFinder(Segments const& segments, PaddedGrid<float> const& heights, std::size_t least_px,
               double scale)
      : labels_(segments.labels),
        heights_(heights),
        least_px_(least_px),
        rim_px_(std::max(1, static_cast<int>(std::lround(kRim_px * scale)))),
        blurred_px_(std::max(1, static_cast<int>(std::lround(kBlurred_px * scale)))) {}

  /// In the order of their first pixels, those of one piece together.
  std::vector<Runs> found() && {
    look(high_runs(), 0);
    return std::move(found_);
  }

private:
  /// Pairs of a pixel of a piece and a neighbour outside: on the same segment, and on others.
  struct Edge {
    std::size_t on_it = 0;
    std::size_t beside = 0;
    /// Of the former, the differences across four pixels.
    double steps = 0.0;
  };

  /// What stands out at the first level.
  [[nodiscard]] Runs high_runs() const {
    int const width = labels_.width();
    RowBits high(width);
    Runs runs;
    for (int v = 0; v < labels_.height(); ++v) {
      segments::higher_bits(heights_.row(v), kLevels.front(), static_cast<std::size_t>(width),
                            high.data());
      std::span<std::int32_t const> const row = labels_.row(v);
      for (int u = high.next_set(0); u < width; u = high.next_set(u)) {
        auto begin = static_cast<std::size_t>(u);
        u = high.next_clear(u);
        for (std::size_t end = 0; begin < static_cast<std::size_t>(u); begin = end) {
          end = run_end(row.first(static_cast<std::size_t>(u)), begin);
          runs.push_back({v, static_cast<int>(begin), static_cast<int>(end), row[begin]});
        }
      }
    }
    return runs;
  }

  /// The things among runs that are higher than a level, or in what of them is higher than the
  /// next.
  void look(Runs const& runs, std::size_t level) {
    for (Runs& piece : large_pieces(runs)) {
      if (!is_high(piece)) {
        continue;
      }
      if (is_thing(piece)) {
        add(higher(piece, 0.5F * middle_height(piece)));
      } else if (level + 1 < kLevels.size()) {
        look(higher(piece, kLevels[level + 1]), level + 1);
      }
    }
  }

  /// What is between two things may be as high as the level that they were found at.
  void add(Runs&& high) {
    std::vector<Runs> parts = large_pieces(high);
    std::size_t most_px = 0;
    for (Runs const& part : parts) {
      most_px = std::max(most_px, pixels_of(part));
    }
    std::erase_if(parts, [&](Runs const& part) {
      return static_cast<double>(pixels_of(part)) < kLeastOfLargest * static_cast<double>(most_px);
    });
    if (parts.size() < 2) {
      found_.push_back(std::move(high));
    } else {
      std::ranges::move(parts, std::back_inserter(found_));
    }
  }

  /// In the order of their first pixels.
  [[nodiscard]] std::vector<Runs> large_pieces(Runs const& runs) const {
    std::vector<std::size_t> const first = first_of_each(runs);
    std::vector<std::size_t> pixels(runs.size(), 0);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      pixels[first[i]] += static_cast<std::size_t>(runs[i].end - runs[i].begin);
    }
    std::vector<Runs> pieces;
    std::vector<std::size_t> piece_of(runs.size(), 0);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (pixels[first[i]] < least_px_) {
        continue;
      }
      if (first[i] == i) {
        piece_of[i] = pieces.size();
        pieces.emplace_back();
      }
      pieces[piece_of[first[i]]].push_back(runs[i]);
    }
    return pieces;
  }

  /// Whether any of it is as high as a thing's middle.
  [[nodiscard]] bool is_high(Runs const& piece) const {
    return std::ranges::any_of(piece, [&](Run const& run) { return high_pixels(run, 1.0F) > 0; });
  }

  /// Whether its middle height is as high as a clearly high one.
  [[nodiscard]] bool is_clearly_high(Runs const& piece) const {
    int pixels = 0;
    int high = 0;
    for (Run const& run : piece) {
      pixels += run.end - run.begin;
      high += high_pixels(run, kClearlyHigh);
    }
    return high >= pixels - pixels / 2;
  }

  /// How many of a run's are that high.
  [[nodiscard]] int high_pixels(Run const& run, float least) const {
    float const* const row = heights_.row(run.v);
    // Without a branch, so that it vectorises.
    int high = 0;
    for (int u = run.begin; u < run.end; ++u) {
      high += row[u] >= least ? 1 : 0;
    }
    return high;
  }

  [[nodiscard]] bool is_thing(Runs const& piece) const {
    Edge const edge = edge_of(piece);
    auto const on_it = static_cast<double>(edge.on_it);
    auto const beside = static_cast<double>(edge.beside);
    double const most_beside = kBeside * (on_it + beside);
    return beside <= most_beside &&
           (edge.steps >= kLeastStep * on_it ||
            (is_clearly_high(piece) && blurred_steps(piece) >= kLeastStep * on_it)) &&
           beside + rim(piece) <= most_beside;
  }

  [[nodiscard]] Edge edge_of(Runs const& piece) const {
    Edge edge;
    for_outline(piece, [&](Pixel p, Pixel q) {
      if (labels_[q] != labels_[p]) {
        ++edge.beside;
      } else {
        ++edge.on_it;
        edge.steps += height_beyond(q, p, kAway_px) - height_beyond(p, q, kAway_px);
      }
    });
    return edge;
  }

  /// Of the pairs on the same segment, the differences across as many pixels as blur may take.
  [[nodiscard]] double blurred_steps(Runs const& piece) const {
    double steps = 0.0;
    for_outline(piece, [&](Pixel p, Pixel q) {
      if (labels_[q] == labels_[p]) {
        steps += std::max(height_beyond(q, p, kAway_px), height_beyond(q, p, blurred_px_)) -
                 std::min(height_beyond(p, q, kAway_px), height_beyond(p, q, blurred_px_));
      }
    });
    return steps;
  }

  /// Of the pairs on the same segment, those that have another not far outside.
  [[nodiscard]] double rim(Runs const& piece) const {
    std::size_t pairs = 0;
    for_outline(piece, [&](Pixel p, Pixel q) {
      Pixel const beyond{p.u + rim_px_ * (q.u - p.u), p.v + rim_px_ * (q.v - p.v)};
      bool const is_other =
          labels_.contains(beyond) && labels_[beyond] != 0 && labels_[beyond] != labels_[p];
      pairs += labels_[q] == labels_[p] && is_other ? 1 : 0;
    });
    return static_cast<double>(pairs);
  }

  /// Calls `visit(p, q)` for each pixel p of a piece and neighbour q outside that has a segment.
  template <typename Visit>
  void for_outline(Runs const& piece, Visit const& visit) const {
    auto const visit_pair = [&](Pixel p, Pixel q) {
      if (labels_.contains(q) && labels_[q] != 0) {
        visit(p, q);
      }
    };
    for (Run const& run : piece) {
      visit_pair({run.begin, run.v}, {run.begin - 1, run.v});
      visit_pair({run.end - 1, run.v}, {run.end, run.v});
    }
    for (int const below : {-1, 1}) {
      for_each_with_next(piece, below, [&](std::size_t i, std::size_t first, std::size_t last) {
        Run const& run = piece[i];
        int u = run.begin;
        auto const visit_until = [&](int end) {
          for (; u < end; ++u) {
            visit_pair({u, run.v}, {u, run.v + below});
          }
        };
        for (std::size_t next = first; next < last; ++next) {
          visit_until(piece[next].begin);
          u = piece[next].end;
        }
        visit_until(run.end);
      });
    }
  }

  /// Of two neighbours on one segment, the height so many pixels beyond the second; at the second
  /// itself where that is not on the segment.
  [[nodiscard]] double height_beyond(Pixel first, Pixel second, int px) const {
    Pixel const beyond{second.u + px * (second.u - first.u), second.v + px * (second.v - first.v)};
    bool const is_same = labels_.contains(beyond) && labels_[beyond] == labels_[second];
    Pixel const at = is_same ? beyond : second;
    return static_cast<double>(heights_.row(at.v)[at.u]);
  }

  /// What of a piece is higher than that.
  [[nodiscard]] Runs higher(Runs const& piece, float than) const {
    Runs runs;
    for (Run const& run : piece) {
      float const* const row = heights_.row(run.v);
      for (int u = run.begin; u < run.end; ++u) {
        if (row[u] <= than) {
          continue;
        }
        int const begin = u;
        while (u < run.end && row[u] > than) {
          ++u;
        }
        runs.push_back({run.v, begin, u, run.label});
      }
    }
    return runs;
  }

  /// Means over neighbours have made a thing wider: its edge is where it is half as high as this.
  [[nodiscard]] float middle_height(Runs const& piece) const {
    std::vector<float> heights;
    for (Run const& run : piece) {
      float const* const row = heights_.row(run.v);
      heights.insert(heights.end(), row + run.begin, row + run.end);
    }
    auto const middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::ranges::nth_element(heights, middle);
    return *middle;
  }

  Grid<std::int32_t> const& labels_;
  PaddedGrid<float> const& heights_;
  std::size_t least_px_;
  int rim_px_;
  int blurred_px_;
  std::vector<Runs> found_;
};

}  // namespace

Segments with_raised_things(Segments segments, Grid<float> const& depth_m, double focal_px,
                            SegmentsConfig const& config) {
  double const scale = focal_px / kReferenceFocal_px;
  auto const least_px =
      static_cast<std::size_t>(std::max(1.0, std::round(config.raised_min_pixels * scale * scale)));
  PaddedGrid<float> const heights = segments::relief(segments, depth_m, focal_px, config);
  segments.lies_on.assign(segments.pixel_counts.size(), 0);
  for (Runs const& raised : RaisedFinder(segments, heights, least_px, scale).found()) {
    std::int32_t const base = raised.front().label;
    auto const label = static_cast<std::int32_t>(segments.pixel_counts.size() + 1);
    for (Run const& run : raised) {
      std::fill_n(segments.labels.row(run.v).begin() + run.begin, run.end - run.begin, label);
    }
    auto const pixels = static_cast<std::uint32_t>(pixels_of(raised));
    segments.pixel_counts[static_cast<std::size_t>(base - 1)] -= pixels;
    segments.pixel_counts.push_back(pixels);
    segments.lies_on.push_back(base);
  }
  return segments;
}

}  // namespace credo
