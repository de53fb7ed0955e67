#include "support/literal_convexity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <map>
#include <vector>

namespace credo::test {
namespace {

constexpr int kUnitsPerQuantum = 16;
constexpr int kThickest = 4;
constexpr std::size_t kKeys = 63;

/// In the order in which fronts advance.
constexpr std::array<Pixel, 4> kNeighbours = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

Pixel operator+(Pixel a, Pixel b) {
  return {a.u + b.u, a.v + b.v};
}

Pixel operator-(Pixel a, Pixel b) {
  return {a.u - b.u, a.v - b.v};
}

template <typename T>
int value(Grid<T> const& grid, Pixel p) {
  return grid.contains(p) ? static_cast<int>(grid[p]) : 0;
}

/// All pixels, row by row.
std::vector<Pixel> pixels_of(Grid<int> const& grid) {
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    pixels.push_back(grid.pixel(i));
  }
  return pixels;
}

std::vector<Pixel> square(Pixel centre, int radius) {
  std::vector<Pixel> pixels;
  for (int v = -radius; v <= radius; ++v) {
    for (int u = -radius; u <= radius; ++u) {
      pixels.push_back(centre + Pixel{u, v});
    }
  }
  return pixels;
}

bool linked(Grid<int> const& disparity, Pixel a, Pixel b, int limit) {
  return value(disparity, a) > 0 && value(disparity, b) > 0 &&
         std::abs(disparity[a] - disparity[b]) < limit;
}

Grid<int> disparity_of(Grid<float> const& depth_m, LiteralLimits const& limits) {
  Grid<int> disparity(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    float const z = depth_m[i];
    if (z > 0.0F && std::isfinite(z)) {
      float const units = std::min(static_cast<float>(limits.units_m) / z, 32000.0F);
      disparity[i] = static_cast<int>(units + 0.5F);
    }
  }
  return disparity;
}

Grid<int> smoothed(Grid<int> const& disparity, LiteralLimits const& limits) {
  Grid<int> smooth(disparity.width(), disparity.height());
  for (Pixel const p : pixels_of(disparity)) {
    if (disparity[p] == 0) {
      continue;
    }
    int sum = 0;
    int count = 0;
    for (Pixel const q : square(p, limits.smooth_radius_px)) {
      if (linked(disparity, p, q, limits.smooth)) {
        sum += disparity[q] - disparity[p];
        ++count;
      }
    }
    float const mean = static_cast<float>(sum) / static_cast<float>(count);
    smooth[p] = disparity[p] + static_cast<int>(std::nearbyint(mean));
  }
  return smooth;
}

struct Bends {
  Grid<int> concavity;
  Grid<int> steepness;
};

Bends bends_of(Grid<int> const& smooth, LiteralLimits const& limits) {
  std::array<Pixel, 4> const offsets = {{{limits.reach_px, 0},
                                         {0, limits.reach_px},
                                         {limits.diagonal_px, limits.diagonal_px},
                                         {limits.diagonal_px, -limits.diagonal_px}}};
  Bends bends{Grid<int>(smooth.width(), smooth.height()),
              Grid<int>(smooth.width(), smooth.height())};
  for (Pixel const p : pixels_of(smooth)) {
    int far = 0;
    for (Pixel const offset : offsets) {
      Pixel const twice = offset + offset;
      if (linked(smooth, p, p + offset, limits.reach) &&
          linked(smooth, p, p - offset, limits.reach)) {
        int const a = smooth[p + offset];
        int const b = smooth[p - offset];
        bends.concavity[p] = std::max(bends.concavity[p], a + b - 2 * smooth[p]);
        bends.steepness[p] = std::max(bends.steepness[p], std::abs(a - b));
      }
      if (linked(smooth, p, p + twice, limits.reach) &&
          linked(smooth, p, p - twice, limits.reach)) {
        far = std::max(far, smooth[p + twice] + smooth[p - twice] - 2 * smooth[p]);
      }
    }
    bends.concavity[p] = std::max(bends.concavity[p], far * limits.far_weight / 32768);
  }
  return bends;
}

/// The third quartile of the concavity on a coarse grid.
int noise_of(Grid<int> const& disparity, Grid<int> const& concavity) {
  std::vector<int> sample;
  for (Pixel const p : pixels_of(disparity)) {
    if (p.u % 5 == 0 && p.v % 3 == 0 && disparity[p] > 0) {
      sample.push_back(concavity[p]);
    }
  }
  std::ranges::sort(sample);
  return sample.empty() ? 0 : sample[sample.size() * 3 / 4];
}

Grid<std::uint8_t> walls_of(Grid<int> const& disparity, Bends const& bends,
                            LiteralLimits const& limits) {
  int const noise = noise_of(disparity, bends.concavity);
  int const crease =
      std::max(limits.crease, static_cast<int>(std::lround(limits.crease_noise * noise)));
  Grid<std::uint8_t> wall(disparity.width(), disparity.height());
  for (Pixel const p : pixels_of(disparity)) {
    int const more = limits.slope * bends.steepness[p] / 65536;
    wall[p] = bends.concavity[p] > crease + more ? 1 : 0;
  }
  return wall;
}

bool ends_at_a_jump(Grid<int> const& disparity, Pixel p, int limit) {
  return std::ranges::any_of(kNeighbours, [&](Pixel const step) {
    return value(disparity, p + step) > 0 && !linked(disparity, p, p + step, limit);
  });
}

Grid<std::uint8_t> thickness_of(Grid<int> const& disparity, Grid<std::uint8_t> const& wall,
                                LiteralLimits const& limits) {
  Grid<std::uint8_t> thickness(disparity.width(), disparity.height());
  for (Pixel const p : pixels_of(disparity)) {
    bool const solid =
        disparity[p] > 0 && wall[p] == 0 && !ends_at_a_jump(disparity, p, limits.link);
    thickness[p] = solid ? 1 : 0;
  }
  for (int level = 1; level < kThickest; ++level) {
    Grid<std::uint8_t> const before = thickness;
    for (Pixel const p : pixels_of(disparity)) {
      bool const inside = std::ranges::all_of(
          square(p, 1), [&](Pixel const q) { return value(before, q) >= level; });
      if (inside) {
        thickness[p] = static_cast<std::uint8_t>(level + 1);
      }
    }
  }
  return thickness;
}

/// Connected pixels of that thickness without a label, from `start` on.
std::vector<Pixel> component(LiteralSurfaces const& surfaces, Grid<int> const& labels, int level,
                             Pixel start, Grid<std::uint8_t>& seen) {
  std::vector<Pixel> part;
  auto const add = [&](Pixel p) {
    if (value(surfaces.thickness, p) >= level && labels[p] == 0 && seen[p] == 0) {
      seen[p] = 1;
      part.push_back(p);
    }
  };
  add(start);
  for (std::size_t i = 0; i < part.size(); ++i) {
    for (Pixel const step : kNeighbours) {
      add(part[i] + step);
    }
  }
  return part;
}

void begin_parts(LiteralSurfaces const& surfaces, int level, int least_px, Grid<int>& labels) {
  Grid<std::uint8_t> seen(labels.width(), labels.height());
  int next = labels.empty() ? 1 : *std::ranges::max_element(labels) + 1;
  for (Pixel const start : pixels_of(labels)) {
    std::vector<Pixel> const part = component(surfaces, labels, level, start, seen);
    if (static_cast<int>(part.size()) < std::max(1, least_px)) {
      continue;
    }
    for (Pixel const p : part) {
      labels[p] = next;
    }
    ++next;
  }
}

/// The first layer: what has no label and passes takes that of the first of its neighbours that has
/// one and passes with it; in raster order.
template <typename IsOpen, typename MayCome>
std::vector<Pixel> advance_once(Grid<int>& labels, IsOpen const& is_open, MayCome const& may_come) {
  Grid<int> const before = labels;
  std::vector<Pixel> taken;
  for (Pixel const p : pixels_of(labels)) {
    for (Pixel const step : {Pixel{0, -1}, Pixel{-1, 0}, Pixel{1, 0}, Pixel{0, 1}}) {
      Pixel const from = p + step;
      if (labels[p] == 0 && is_open(p) && value(before, from) != 0 && may_come(from, p)) {
        labels[p] = before[from];
        taken.push_back(p);
      }
    }
  }
  return taken;
}

void grow(LiteralSurfaces const& surfaces, int level, Grid<int>& labels) {
  auto const is_open = [&](Pixel p) { return value(surfaces.thickness, p) >= level; };
  std::vector<Pixel> const first = advance_once(labels, is_open, [](Pixel, Pixel) { return true; });
  std::deque<Pixel> queue(first.begin(), first.end());
  for (; !queue.empty(); queue.pop_front()) {
    for (Pixel const step : kNeighbours) {
      Pixel const next = queue.front() + step;
      if (is_open(next) && labels[next] == 0) {
        labels[next] = labels[queue.front()];
        queue.push_back(next);
      }
    }
  }
}

/// The rest, least concave first.
void flood(LiteralSurfaces const& surfaces, LiteralLimits const& limits, bool along_surfaces,
           Grid<int>& labels) {
  std::array<std::deque<Pixel>, kKeys> queues;
  auto const add = [&](Pixel p, std::size_t key) {
    auto const own = static_cast<std::size_t>(surfaces.concavity[p] * 2 / kUnitsPerQuantum);
    queues.at(std::max(key, std::min(own, kKeys - 1))).push_back(p);
  };
  auto const may_come = [&](Pixel from, Pixel to) {
    return !along_surfaces || linked(surfaces.disparity, from, to, limits.link);
  };
  auto const is_open = [&](Pixel p) { return value(surfaces.disparity, p) != 0; };
  for (Pixel const p : advance_once(labels, is_open, may_come)) {
    add(p, 0);
  }
  for (std::size_t key = 0; key < kKeys; ++key) {
    for (; !queues.at(key).empty(); queues.at(key).pop_front()) {
      Pixel const p = queues.at(key).front();
      for (Pixel const step : kNeighbours) {
        Pixel const next = p + step;
        if (is_open(next) && labels[next] == 0 && may_come(p, next)) {
          labels[next] = labels[p];
          add(next, key);
        }
      }
    }
  }
}

/// In the order of their first pixels.
Segments numbered(Grid<int> const& labels) {
  Segments segments;
  segments.labels = Grid<std::int32_t>(labels.width(), labels.height());
  std::map<int, std::int32_t> number_of;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0) {
      continue;
    }
    auto const [found, is_new] =
        number_of.try_emplace(labels[i], static_cast<std::int32_t>(number_of.size() + 1));
    if (is_new) {
      segments.pixel_counts.push_back(0);
    }
    segments.labels[i] = found->second;
    ++segments.pixel_counts[static_cast<std::size_t>(found->second - 1)];
  }
  return segments;
}

}  // namespace

LiteralLimits literal_limits(double focal_px, SegmentsConfig const& config) {
  double const scale = focal_px / 525.0;
  auto const length_px = [&](double px, int most) {
    return std::clamp(static_cast<int>(std::lround(px * scale)), 1, most);
  };
  auto const area_px = [&](double px) {
    return std::max(1, static_cast<int>(std::lround(px * scale * scale)));
  };
  auto const units = [](double quanta) {
    return static_cast<int>(std::lround(quanta * kUnitsPerQuantum));
  };
  return {.units_m = kUnitsPerQuantum / config.quantum_per_m,
          .link = units(config.link_quanta),
          .smooth = units(config.smooth_quanta),
          .smooth_radius_px = length_px(config.smooth_radius_px, 8),
          .reach_px = length_px(config.reach_px, 32),
          .diagonal_px = length_px(config.reach_px * std::sqrt(0.5), 32),
          .reach = units(config.reach_quanta),
          .far_weight = std::min(static_cast<int>(std::lround(config.far_weight * 32768)), 32767),
          .crease = units(config.crease_quanta),
          .crease_noise = config.crease_noise,
          .slope = static_cast<int>(std::lround(config.crease_slope / 12.0 * 65536.0)),
          .disc_px = length_px(config.disc_radius_px, 255),
          .seed_px = area_px(4),
          .part_px = area_px(config.min_pixels),
          .small_px = area_px(1000),
          .border_px = area_px(400)};
}

LiteralSurfaces literal_surfaces(Grid<float> const& depth_m, LiteralLimits const& limits) {
  LiteralSurfaces surfaces;
  surfaces.disparity = disparity_of(depth_m, limits);
  Bends const bends = bends_of(smoothed(surfaces.disparity, limits), limits);
  surfaces.concavity = bends.concavity;
  surfaces.wall = walls_of(surfaces.disparity, bends, limits);
  surfaces.thickness = thickness_of(surfaces.disparity, surfaces.wall, limits);
  return surfaces;
}

Grid<int> literal_parts(LiteralSurfaces const& surfaces, LiteralLimits const& limits) {
  Grid<int> labels(surfaces.disparity.width(), surfaces.disparity.height());
  begin_parts(surfaces, kThickest, limits.seed_px, labels);
  for (int const level : {2, 1}) {
    grow(surfaces, level, labels);
    begin_parts(surfaces, level, limits.part_px, labels);
  }
  flood(surfaces, limits, true, labels);
  flood(surfaces, limits, false, labels);
  return labels;
}

Segments literal_convex_segments(Grid<float> const& depth_m, double focal_px,
                                 SegmentsConfig const& config) {
  LiteralLimits const limits = literal_limits(focal_px, config);
  LiteralSurfaces const surfaces = literal_surfaces(depth_m, limits);
  Grid<int> labels = literal_parts(surfaces, limits);
  join_literal_parts(surfaces, limits, labels);
  return numbered(labels);
}

}  // namespace credo::test
