#include "stages/segments/convexity/region_merge.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace credo::segments {
namespace {

/// Below this they join.
constexpr double kJoins = 0.5;
constexpr std::uint32_t kLeastPairs = 8;

/// How much holds two parts apart.
std::optional<double> strength(Border const& border, std::uint32_t smaller_px,
                               Limits const& limits) {
  if (border.pairs < kLeastPairs) {
    return std::nullopt;
  }
  double const parted = static_cast<double>(border.parted) / static_cast<double>(border.pairs);
  double const score = border.samples > 0
                           ? 0.3 * parted + 0.7 * (static_cast<double>(border.unlike) /
                                                   static_cast<double>(border.samples))
                           : parted;
  return score - (smaller_px < limits.small_px ? 0.1 : 0.0);
}

class Joiner {
public:
  Joiner(RegionGraph& graph, Limits const& limits)
      : graph_(graph), limits_(limits), borders_of_(graph.sizes.size()), root_(graph.sizes.size()) {
    std::iota(root_.begin(), root_.end(), 0);
    for (Border const& border : graph.borders) {
      at(border.low).emplace(border.high, border);
      at(border.high).emplace(border.low, border);
      offer(border);
    }
  }

  std::vector<std::int32_t> joined() && {
    while (!queue_.empty()) {
      auto const [score, low, high] = queue_.top();
      queue_.pop();
      // Only the last offer of a border that is still there counts.
      auto const found = at(low).find(high);
      if (found != at(low).end() && strength_of(found->second) == score) {
        join(low, high);
      }
    }
    for (std::size_t i = 0; i < root_.size(); ++i) {
      // A label goes into a lower one, whose way is known.
      root_[i] = root_[static_cast<std::size_t>(root_[i])];
    }
    return std::move(root_);
  }

private:
  using Borders = std::map<std::int32_t, Border>;
  using Offer = std::tuple<double, std::int32_t, std::int32_t>;

  Borders& at(std::int32_t label) { return borders_of_[static_cast<std::size_t>(label)]; }
  std::uint32_t& size(std::int32_t label) { return graph_.sizes[static_cast<std::size_t>(label)]; }

  std::optional<double> strength_of(Border const& border) {
    return strength(border, std::min(size(border.low), size(border.high)), limits_);
  }
  void offer(Border const& border) {
    if (auto const score = strength_of(border); score && *score < kJoins) {
      queue_.emplace(*score, border.low, border.high);
    }
  }

  [[nodiscard]] bool is_small(std::int32_t label) { return size(label) < limits_.small_px; }

  /// Looks at the borders of `from` alone, so that a table takes thousands of crumbs in without
  /// going through all of its borders for each of them.
  void join(std::int32_t into, std::int32_t from) {
    bool const was_small = is_small(into);
    size(into) += size(from);
    root_[static_cast<std::size_t>(from)] = into;
    at(into).erase(from);
    at(from).erase(into);
    for (auto const& [other, border] : at(from)) {
      at(other).erase(from);
      Border& joined = at(into).try_emplace(other, Border{}).first->second;
      joined = {std::min(into, other),           std::max(into, other),
                joined.pairs + border.pairs,     joined.parted + border.parted,
                joined.samples + border.samples, joined.unlike + border.unlike};
      at(other).insert_or_assign(into, joined);
      offer(joined);
    }
    at(from).clear();
    if (was_small && !is_small(into)) {
      // All of its borders are stronger than they were.
      for (auto const& [other, border] : at(into)) {
        offer(border);
      }
    }
  }

  RegionGraph& graph_;
  Limits const& limits_;
  std::vector<Borders> borders_of_;
  std::vector<std::int32_t> root_;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> queue_;
};

/// How far a plane is from a pixel.
double error(DiscPlane const& plane, int u, int v, double quanta) {
  return std::abs(quanta - plane.at(u, v));
}

}  // namespace

std::vector<std::int32_t> joined_parts(RegionGraph& graph, Limits const& limits) {
  return Joiner(graph, limits).joined();
}

void sharpen_borders(SurfaceMap const& map, RegionGraph const& graph,
                     std::vector<std::int32_t> const& root, Limits const& limits,
                     PartLabels& labels) {
  std::int32_t* const label = labels.row(0);
  std::int16_t const* const disparity = map.disparity.row(0);
  auto const whole_at = [&](std::ptrdiff_t p) { return root[static_cast<std::size_t>(label[p])]; };
  auto const is_large = [&](std::int32_t part) {
    return graph.sizes[static_cast<std::size_t>(part)] >= limits.border_px;
  };
  for (BorderSample const& sample : graph.samples) {
    std::int32_t const a = whole_at(sample.at);
    std::int32_t const b = whole_at(sample.beside);
    if (a == b || !is_large(a) || !is_large(b)) {
      continue;
    }
    for (int v = -1; v <= 1; ++v) {
      for (int u = -1; u <= 1; ++u) {
        std::ptrdiff_t const p = sample.at + v * labels.stride() + u;
        std::int32_t const whole = whole_at(p);
        if (whole != a && whole != b) {
          continue;
        }
        double const quanta = static_cast<double>(disparity[p]) / kUnitsPerQuantum;
        double const error_a = error(sample.plane, u, v, quanta);
        double const error_b = error(sample.plane_beside, u, v, quanta);
        if (whole == a && error_b + 1.0 < error_a) {
          label[p] = b;
        } else if (whole == b && error_a + 1.0 < error_b) {
          label[p] = a;
        }
      }
    }
  }
}

}  // namespace credo::segments
