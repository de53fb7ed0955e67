#include "geometry/reachability/groups.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace credo::reachability {
namespace {

constexpr std::size_t kNone = ~std::size_t{0};
// With more pairs of groups than this, the pairs of pixels are tested right away: a pair of tiles
// never costs more than that.
constexpr std::size_t kMaxGroupPairs = 150;

// The groups of one row of tiles while they are gathered: a chain for each tile.
class TileRow {
public:
  explicit TileRow(std::size_t tiles) : first_(tiles, kNone) {}

  void add(Run const& run, std::int32_t root) {
    auto const begin = static_cast<unsigned>(run.begin);
    auto const end = static_cast<unsigned>(run.end);
    unsigned const shift = kTile * (static_cast<unsigned>(run.v) % kTile);
    for (unsigned tu = begin / kTile; tu * kTile < end; ++tu) {
      unsigned const left = tu * kTile;
      unsigned const from = std::max(begin, left) - left;
      unsigned const to = std::min(end, left + kTile) - left;
      std::uint64_t const columns = (1U << to) - (1U << from);
      mask_of(tu, root) |= columns << shift;
    }
  }

  // Appends the groups of a tile, whose first pixel is (left, top), and forgets them.
  void move_to(std::vector<Group>& groups, std::size_t tu, int left, int top, int width) {
    for (std::size_t i = first_[tu]; i != kNone; i = drafts_[i].next) {
      // The last tile of a row is moved left until all its columns lie inside the image.
      int const u = std::min(left, width - kTile);
      Group& group = groups.emplace_back();
      group.pixels = {.u = u, .v = top, .mask = drafts_[i].mask << (left - u)};
      group.root = drafts_[i].root;
    }
    first_[tu] = kNone;
  }
  void clear() { drafts_.clear(); }

private:
  struct Draft {
    std::uint64_t mask = 0;
    std::int32_t root = 0;
    std::size_t next = kNone;
  };

  std::uint64_t& mask_of(std::size_t tu, std::int32_t root) {
    for (std::size_t i = first_[tu]; i != kNone; i = drafts_[i].next) {
      if (drafts_[i].root == root) {
        return drafts_[i].mask;
      }
    }
    drafts_.push_back({.root = root, .next = first_[tu]});
    first_[tu] = drafts_.size() - 1;
    return drafts_.back().mask;
  }

  std::vector<std::size_t> first_;
  std::vector<Draft> drafts_;
};

// Squared distance of two boxes. The differences and squares are rounded like those of
// within_reach, and rounding is monotonic: a bound of the rounded distances too.
float squared_gap(Box const& a, Box const& b) {
  auto const gap = [&](std::size_t i) {
    return std::max(0.0F, std::max(a.min[i] - b.max[i], b.min[i] - a.max[i]));
  };
  return ordered_squared_norm(gap(0), gap(1), gap(2));
}

// Squared distance of the farthest corners.
float squared_span(Box const& a, Box const& b) {
  auto const span = [&](std::size_t i) {
    return std::max(a.max[i] - b.min[i], b.max[i] - a.min[i]);
  };
  return ordered_squared_norm(span(0), span(1), span(2));
}

TilePixels all_pixels(std::span<Group const> groups) {
  TilePixels all = groups[0].pixels;
  for (Group const& group : groups) {
    all.mask |= group.pixels.mask;
  }
  return all;
}

}  // namespace

TileGroups::TileGroups(int width, LinkBits const& links, std::vector<Run> const& runs,
                       DisjointSets& sets)
    : ranges_(links.layout.block_count * TileLayout::kTilesPerBlock) {
  groups_.reserve(ranges_.size() + runs.size() / 8);
  TileRow row(links.layout.tiles_u);
  std::size_t run = 0;
  for (std::size_t tv = 0; tv < links.layout.tiles_v; ++tv) {
    int const top = static_cast<int>(tv) * kTile;
    row.clear();
    for (; run < runs.size() && runs[run].v < top + kTile; ++run) {
      row.add(runs[run], sets.root(static_cast<std::int32_t>(run)));
    }
    for (std::size_t tu = 0; tu < links.layout.tiles_u; ++tu) {
      std::size_t const tile = links.layout.tile_at(tu, tv);
      ranges_[tile].begin = groups_.size();
      row.move_to(groups_, tu, static_cast<int>(tu) * kTile, top, width);
      ranges_[tile].end = groups_.size();
      if (ranges_[tile].end - ranges_[tile].begin == 1) {
        groups_.back().points = links.tiles.box(tile);
        groups_.back().has_points = true;
      }
    }
  }
}

void TileGroups::join(std::size_t tile, DisjointSets& sets, BoxList& tiles) {
  std::span<Group> const groups = of_tile(tile);
  std::size_t kept = 0;
  for (Group& group : groups) {
    group.root = sets.root(group.root);
    std::span<Group> const before = groups.first(kept);
    auto const same =
        std::ranges::find_if(before, [&](Group const& g) { return g.root == group.root; });
    if (same == before.end()) {
      groups[kept++] = group;
    } else {
      same->pixels.mask |= group.pixels.mask;
      same->has_points = same->has_normals = false;
    }
  }
  ranges_[tile].end = ranges_[tile].begin + kept;
  tiles.first_root[tile] = std::numeric_limits<std::int32_t>::max();
  tiles.last_root[tile] = -1;
  for (Group const& group : groups.first(kept)) {
    tiles.first_root[tile] = std::min(tiles.first_root[tile], group.root);
    tiles.last_root[tile] = std::max(tiles.last_root[tile], group.root);
  }
}

std::size_t TileGroups::occupied_tile_count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(ranges_, [](Range const& r) { return r.begin < r.end; }));
}

std::size_t TileGroups::group_count() const {
  std::size_t count = 0;
  for (Range const& range : ranges_) {
    count += range.end - range.begin;
  }
  return count;
}

GroupPairs::GroupPairs(PointArrays const& points, LinkBits const& links,
                       ReachThresholds const& reach, DisjointSets& sets)
    : points_(points), reach_(reach), sets_(sets) {
  // |n - m|^2 = |n|^2 + |m|^2 - 2 n.m, with a margin far above the rounding of n.m.
  float const margin = 1e-5F * (links.max_squared_normal + std::abs(reach.min_cosine));
  max_squared_turn_ = 2.0F * (links.max_squared_normal - reach.min_cosine) + margin;
  sure_squared_turn_ = 2.0F * (links.min_squared_normal - reach.min_cosine) - margin;
}

Box const& GroupPairs::points_of(Group& group) const {
  if (!group.has_points) {
    group.points = box_of(points_.point, points_.width, group.pixels);
    group.has_points = true;
  }
  return group.points;
}

Box const& GroupPairs::normals_of(Group& group) const {
  if (!group.has_normals) {
    group.normals = box_of(points_.normal, points_.width, group.pixels);
    group.has_normals = true;
  }
  return group.normals;
}

bool GroupPairs::apart(Group const& a, Group const& b) const {
  return squared_gap(a.points, b.points) > reach_.max_squared_distance_m2 ||
         squared_gap(a.normals, b.normals) > max_squared_turn_;
}

void GroupPairs::unite(Group& a, Group& b) {
  if (a.root == b.root) {
    return;
  }
  Box const& points_a = points_of(a);
  Box const& points_b = points_of(b);
  if (squared_gap(points_a, points_b) > reach_.max_squared_distance_m2 ||
      sets_.root(a.root) == sets_.root(b.root)) {
    return;
  }
  Box const& normals_a = normals_of(a);
  Box const& normals_b = normals_of(b);
  if (squared_gap(normals_a, normals_b) > max_squared_turn_) {
    return;
  }
  bool const all_in_reach = squared_span(points_a, points_b) <= reach_.max_squared_distance_m2 &&
                            squared_span(normals_a, normals_b) < sure_squared_turn_;
  if (all_in_reach || any_within_reach(points_, a.pixels, points_a, b.pixels, points_b, reach_)) {
    sets_.unite(a.root, b.root);
  }
}

void GroupPairs::unite(std::span<Group> a, std::span<Group> b) {
  if (a.size() * b.size() > kMaxGroupPairs) {
    unite_pixels(a, b);
    return;
  }
  for (Group& group_a : a) {
    for (Group& group_b : b) {
      unite(group_a, group_b);
    }
  }
}

void GroupPairs::unite(std::span<Group> groups) {
  if (groups.size() * groups.size() > 2 * kMaxGroupPairs) {
    unite_pixels(groups, groups);
    return;
  }
  for (std::size_t i = 1; i < groups.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      unite(groups[i], groups[j]);
    }
  }
}

void GroupPairs::unite_pixels(std::span<Group const> a, std::span<Group const> b) {
  ++pixel_searches_;
  TilePixels const pixels_b = all_pixels(b);
  std::array<Group const*, std::size_t{kTile} * kTile> group_of{};
  for (Group const& group : b) {
    for (std::uint64_t rest = group.pixels.mask; rest != 0; rest &= rest - 1) {
      group_of[static_cast<std::size_t>(std::countr_zero(rest))] = &group;
    }
  }
  TileLinks const links = tile_links(points_, all_pixels(a), pixels_b, reach_);
  for (Group const& group_a : a) {
    std::uint64_t linked = 0;
    for (std::uint64_t rest = group_a.pixels.mask; rest != 0; rest &= rest - 1) {
      linked |= links[static_cast<std::size_t>(std::countr_zero(rest))];
    }
    while (linked != 0) {
      Group const& group_b = *group_of[static_cast<std::size_t>(std::countr_zero(linked))];
      sets_.unite(group_a.root, group_b.root);
      linked &= ~group_b.pixels.mask;
    }
  }
}

}  // namespace credo::reachability
