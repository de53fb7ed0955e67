#include "geometry/reachability_tiles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace credo::reachability {
namespace {

// Blocks are squares of this many tiles; tiles are counted block by block.
constexpr int kBlock = 4;
constexpr std::size_t kTilesPerBlock = BoxList::kBoxesAtOnce;
static_assert(kTilesPerBlock == kBlock * kBlock);

// Tests of whole sets of points by their bounds. The differences and squares are rounded like those
// of within_reach, and rounding is monotonic: the bounds hold for the rounded distances too.
class BoundsTest {
public:
  BoundsTest(LinkBits const& links, ReachThresholds const& reach)
      : max_squared_distance_(reach.max_squared_distance_m2) {
    // |n - m|^2 = |n|^2 + |m|^2 - 2 n.m, with a margin far above the rounding of n.m.
    float const margin = 1e-5F * (links.max_squared_normal + std::abs(reach.min_cosine));
    max_squared_turn_ = 2.0F * (links.max_squared_normal - reach.min_cosine) + margin;
    sure_squared_turn_ = 2.0F * (links.min_squared_normal - reach.min_cosine) - margin;
  }

  // No pair of points can be neighbours.
  [[nodiscard]] bool none_in_reach(Bounds const& a, Bounds const& b) const {
    auto const gap = [&](std::size_t i) {
      return std::max({0.0F, a.min[i] - b.max[i], b.min[i] - a.max[i]});
    };
    return ordered_squared_norm(gap(0), gap(1), gap(2)) > max_squared_distance_ ||
           ordered_squared_norm(gap(3), gap(4), gap(5)) > max_squared_turn_;
  }

  // Every pair of points is a pair of neighbours.
  [[nodiscard]] bool all_in_reach(Bounds const& a, Bounds const& b) const {
    auto const span = [&](std::size_t i) {
      return std::max(a.max[i] - b.min[i], b.max[i] - a.min[i]);
    };
    return ordered_squared_norm(span(0), span(1), span(2)) <= max_squared_distance_ &&
           ordered_squared_norm(span(3), span(4), span(5)) < sure_squared_turn_;
  }

private:
  float max_squared_distance_ = 0.0F;
  float max_squared_turn_ = 0.0F;
  float sure_squared_turn_ = 0.0F;
};

// The pixels of one tile that belong to one component.
struct Group {
  TilePixels pixels;
  std::int32_t root = 0;
  bool has_bounds = false;
  Bounds bounds{};
};

class TileSearch {
public:
  TileSearch(PointArrays const& points, LinkBits const& links, ReachThresholds const& reach,
             DisjointSets& sets)
      : points_(points),
        reach_(reach),
        bounds_test_(links, reach),
        sets_(sets),
        tiles_u_((points.width + kTile - 1) / kTile),
        tiles_v_((points.height + kTile - 1) / kTile),
        blocks_u_((tiles_u_ + kBlock - 1) / kBlock),
        block_count_(static_cast<std::size_t>(blocks_u_) *
                     static_cast<std::size_t>((tiles_v_ + kBlock - 1) / kBlock)),
        groups_(block_count_ * kTilesPerBlock),
        tiles_(groups_.size()) {}

  void add(std::vector<Run> const& runs);
  void bound_tiles();
  void unite_near_tiles();
  void unite_far_tiles();

private:
  using Groups = std::vector<Group>;

  [[nodiscard]] std::size_t tile_at(int tu, int tv) const {
    return static_cast<std::size_t>(((tv / kBlock) * blocks_u_ + tu / kBlock) * kBlock * kBlock +
                                    (tv % kBlock) * kBlock + tu % kBlock);
  }
  Group& group_of(std::size_t tile, std::int32_t root, int u, int v);
  Bounds const& bounds(Group& group) const;
  void unite_groups(Group& a, Group& b);
  void unite_tiles(std::size_t a, std::size_t b);
  void join_groups();
  void unite_blocks(BoxList const& blocks, std::size_t a, std::size_t b);

  PointArrays points_;
  ReachThresholds reach_;
  BoundsTest bounds_test_;
  DisjointSets& sets_;
  int tiles_u_;
  int tiles_v_;
  int blocks_u_;
  std::size_t block_count_;
  std::vector<Groups> groups_;
  BoxList tiles_;
};

Group& TileSearch::group_of(std::size_t tile, std::int32_t root, int u, int v) {
  for (Group& group : groups_[tile]) {
    if (group.root == root) {
      return group;
    }
  }
  // The last tile of a row is moved left until all its columns lie inside the image.
  return groups_[tile].emplace_back(
      Group{.pixels = {.u = std::min(u, points_.width - kTile), .v = v}, .root = root});
}

void TileSearch::add(std::vector<Run> const& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Run const& run = runs[i];
    std::int32_t const root = sets_.root(static_cast<std::int32_t>(i));
    int const tv = run.v / kTile;
    for (int tu = run.begin / kTile; tu * kTile < run.end; ++tu) {
      Group& group = group_of(tile_at(tu, tv), root, tu * kTile, tv * kTile);
      int const begin = std::max(run.begin, tu * kTile) - group.pixels.u;
      int const end = std::min(run.end, (tu + 1) * kTile) - group.pixels.u;
      std::uint64_t const columns = (1U << end) - (1U << begin);
      group.pixels.mask |= columns << (kTile * (run.v % kTile));
    }
  }
}

void TileSearch::bound_tiles() {
  for (std::size_t tile = 0; tile < groups_.size(); ++tile) {
    Groups& groups = groups_[tile];
    if (groups.empty()) {
      continue;
    }
    TilePixels all = groups[0].pixels;
    tiles_.first_root[tile] = tiles_.last_root[tile] = groups[0].root;
    for (Group const& group : groups) {
      all.mask |= group.pixels.mask;
      tiles_.first_root[tile] = std::min(tiles_.first_root[tile], group.root);
      tiles_.last_root[tile] = std::max(tiles_.last_root[tile], group.root);
    }
    Bounds const bounds = bounds_of(points_, all);
    tiles_.set_bounds(tile, bounds);
    if (groups.size() == 1) {
      groups[0].bounds = bounds;
      groups[0].has_bounds = true;
    }
  }
}

Bounds const& TileSearch::bounds(Group& group) const {
  if (!group.has_bounds) {
    group.bounds = bounds_of(points_, group.pixels);
    group.has_bounds = true;
  }
  return group.bounds;
}

void TileSearch::unite_groups(Group& a, Group& b) {
  if (a.root == b.root) {
    return;
  }
  Bounds const& bounds_a = bounds(a);
  Bounds const& bounds_b = bounds(b);
  if (bounds_test_.none_in_reach(bounds_a, bounds_b) || sets_.root(a.root) == sets_.root(b.root)) {
    return;
  }
  if (bounds_test_.all_in_reach(bounds_a, bounds_b) ||
      any_within_reach(points_, a.pixels, bounds_a, b.pixels, bounds_b, reach_)) {
    sets_.unite(a.root, b.root);
  }
}

void TileSearch::unite_tiles(std::size_t a, std::size_t b) {
  for (Group& group_a : groups_[a]) {
    for (Group& group_b : groups_[b]) {
      unite_groups(group_a, group_b);
    }
  }
}

// Makes one group of those of a tile that have become one component.
void TileSearch::join_groups() {
  for (std::size_t tile = 0; tile < groups_.size(); ++tile) {
    Groups& groups = groups_[tile];
    if (groups.empty()) {
      continue;
    }
    std::size_t kept = 0;
    for (Group& group : groups) {
      group.root = sets_.root(group.root);
      auto const same = std::find_if(groups.begin(), groups.begin() + static_cast<long>(kept),
                                     [&](Group const& g) { return g.root == group.root; });
      if (same == groups.begin() + static_cast<long>(kept)) {
        groups[kept++] = group;
      } else {
        same->pixels.mask |= group.pixels.mask;
        same->has_bounds = false;
      }
    }
    groups.resize(kept);
    auto const [first, last] = std::minmax_element(
        groups.begin(), groups.end(), [](auto const& x, auto const& y) { return x.root < y.root; });
    tiles_.first_root[tile] = first->root;
    tiles_.last_root[tile] = last->root;
  }
}

// Within each tile, then with the four tiles to its right and below.
void TileSearch::unite_near_tiles() {
  for (Groups& groups : groups_) {
    for (std::size_t i = 1; i < groups.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        unite_groups(groups[i], groups[j]);
      }
    }
  }
  join_groups();
  for (int tv = 0; tv < tiles_v_; ++tv) {
    for (int tu = 0; tu < tiles_u_; ++tu) {
      std::size_t const tile = tile_at(tu, tv);
      if (tu + 1 < tiles_u_) {
        unite_tiles(tile, tile_at(tu + 1, tv));
      }
      for (int next = std::max(0, tu - 1); tv + 1 < tiles_v_ && next < std::min(tu + 2, tiles_u_);
           ++next) {
        unite_tiles(tile, tile_at(next, tv + 1));
      }
    }
  }
  join_groups();
}

// Tiles of b that have something for a tile of a; each pair of tiles once.
void TileSearch::unite_blocks(BoxList const& blocks, std::size_t a, std::size_t b) {
  std::uint32_t tiles_a = boxes_in_reach(blocks, b, tiles_, a * kTilesPerBlock, reach_);
  for (; tiles_a != 0; tiles_a &= tiles_a - 1) {
    int const offset_a = std::countr_zero(tiles_a);
    std::size_t const tile_a = a * kTilesPerBlock + static_cast<std::size_t>(offset_a);
    std::uint32_t tiles_b = boxes_in_reach(tiles_, tile_a, tiles_, b * kTilesPerBlock, reach_);
    if (a == b) {
      tiles_b &= ~std::uint32_t{0} << (offset_a + 1);
    }
    for (; tiles_b != 0; tiles_b &= tiles_b - 1) {
      unite_tiles(tile_a, b * kTilesPerBlock + static_cast<std::size_t>(std::countr_zero(tiles_b)));
    }
  }
}

// All pairs of tiles, by way of the bounds of their blocks.
void TileSearch::unite_far_tiles() {
  BoxList blocks(block_count_);
  for (std::size_t tile = 0; tile < groups_.size(); ++tile) {
    blocks.include(tile / kTilesPerBlock, tiles_, tile);
  }
  for (std::size_t a = 0; a < block_count_; ++a) {
    if (blocks.last_root[a] < 0) {
      continue;
    }
    std::size_t const first = a / BoxList::kBoxesAtOnce * BoxList::kBoxesAtOnce;
    for (std::size_t begin = first; begin < block_count_; begin += BoxList::kBoxesAtOnce) {
      std::uint32_t near = boxes_in_reach(blocks, a, blocks, begin, reach_);
      for (; near != 0; near &= near - 1) {
        std::size_t const b = begin + static_cast<std::size_t>(std::countr_zero(near));
        if (b >= a && b < block_count_) {
          unite_blocks(blocks, a, b);
        }
      }
    }
  }
}

}  // namespace

void unite_all_in_reach(PointArrays const& points, LinkBits const& links,
                        std::vector<Run> const& runs, ReachThresholds const& reach,
                        DisjointSets& sets) {
  TileSearch search(points, links, reach, sets);
  search.add(runs);
  search.bound_tiles();
  search.unite_near_tiles();
  search.unite_far_tiles();
}

}  // namespace credo::reachability
