#include "geometry/reachability/tiles.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "geometry/reachability/groups.hpp"

namespace credo::reachability {
namespace {

constexpr std::size_t kTilesPerBlock = TileLayout::kTilesPerBlock;
// Searches of all pixels of two tiles before the groups are looked over. A real frame stays below.
constexpr std::size_t kFirstBudget = 5000;
// More components than this are not compared with each other, nor a group with more components.
constexpr std::size_t kMaxComponents = 1000;
constexpr std::size_t kMaxOthers = 32;
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr Box kNothing{.min = {kInf, kInf, kInf}, .max = {-kInf, -kInf, -kInf}};

void include(Box& box, Box const& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], other.min[axis]);
    box.max[axis] = std::max(box.max[axis], other.max[axis]);
  }
}

class TileSearch {
public:
  TileSearch(PointArrays const& points, LinkBits const& links, std::vector<Run> const& runs,
             ReachThresholds const& reach, DisjointSets& sets)
      : layout_(links.layout),
        tiles_(links.tiles),
        reach_(reach),
        sets_(sets),
        run_count_(runs.size()),
        groups_(points.width, links, runs, sets),
        pairs_(points, links, reach, sets) {}

  void unite_near_tiles();
  void drop_finished_groups();
  void unite_far_tiles();

private:
  void unite_tiles(std::size_t a, std::size_t b) {
    std::int32_t const lowest = std::min(tiles_.first_root[a], tiles_.first_root[b]);
    if (lowest != std::max(tiles_.last_root[a], tiles_.last_root[b])) {
      pairs_.unite(groups_.of_tile(a), groups_.of_tile(b));
    }
  }
  void join_groups() {
    for (std::size_t tile = 0; tile < groups_.tile_count(); ++tile) {
      groups_.join(tile, sets_, tiles_);
    }
  }
  [[nodiscard]] std::vector<Group> components();
  void unite_blocks(BoxList const& blocks, std::size_t a, std::size_t b);

  TileLayout layout_;
  BoxList tiles_;
  ReachThresholds reach_;
  DisjointSets& sets_;
  std::size_t run_count_;
  TileGroups groups_;
  GroupPairs pairs_;
};

// Within each tile, then with the four tiles to its right and below.
void TileSearch::unite_near_tiles() {
  for (std::size_t tile = 0; tile < groups_.tile_count(); ++tile) {
    pairs_.unite(groups_.of_tile(tile));
  }
  join_groups();
  std::size_t const columns = layout_.tiles_u;
  for (std::size_t tv = 0; tv < layout_.tiles_v; ++tv) {
    for (std::size_t tu = 0; tu < columns; ++tu) {
      std::size_t const tile = layout_.tile_at(tu, tv);
      if (tu + 1 < columns) {
        unite_tiles(tile, layout_.tile_at(tu + 1, tv));
      }
      if (tv + 1 < layout_.tiles_v) {
        for (std::size_t next = tu - std::min<std::size_t>(tu, 1); next < std::min(tu + 2, columns);
             ++next) {
          unite_tiles(tile, layout_.tile_at(next, tv + 1));
        }
      }
    }
  }
}

// Root and bounds of each component; none if they are too many to compare all pairs.
std::vector<Group> TileSearch::components() {
  std::vector<Group> components;
  std::vector<std::size_t> index(run_count_, run_count_);
  for (std::size_t tile = 0; tile < groups_.tile_count(); ++tile) {
    for (Group& group : groups_.of_tile(tile)) {
      std::size_t& i = index[static_cast<std::size_t>(group.root)];
      if (i == run_count_) {
        i = components.size();
        components.push_back(
            {.pixels = {}, .root = group.root, .points = kNothing, .normals = kNothing});
      }
      if (components.size() > kMaxComponents) {
        return {};
      }
      include(components[i].points, pairs_.points_of(group));
      include(components[i].normals, pairs_.normals_of(group));
    }
  }
  return components;
}

// Where pixels have groups of their own, the normals are nonsense, and pairs of tiles become
// costly. Joined groups make fewer, and a group that is out of reach of all components but its own
// is needed no more.
void TileSearch::drop_finished_groups() {
  join_groups();
  if (groups_.group_count() < 2 * groups_.occupied_tile_count()) {
    return;
  }
  std::vector<Group> const all = components();
  std::vector<std::vector<Group const*>> in_reach(run_count_);
  for (Group const& a : all) {
    for (Group const& b : all) {
      if (a.root != b.root && !pairs_.apart(a, b)) {
        in_reach[static_cast<std::size_t>(a.root)].push_back(&b);
      }
    }
  }
  for (std::size_t tile = 0; !all.empty() && tile < groups_.tile_count(); ++tile) {
    groups_.erase_if(tile, [&](Group const& group) {
      auto const& others = in_reach[static_cast<std::size_t>(group.root)];
      return others.size() <= kMaxOthers &&
             std::ranges::all_of(others, [&](Group const* b) { return pairs_.apart(group, *b); });
    });
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
  std::size_t const block_count = layout_.block_count;
  BoxList blocks(block_count);
  for (std::size_t tile = 0; tile < groups_.tile_count(); ++tile) {
    blocks.include(tile / kTilesPerBlock, tiles_, tile);
  }
  std::size_t budget = kFirstBudget;
  for (std::size_t a = 0; a < block_count; ++a) {
    if (blocks.last_root[a] < 0) {
      continue;
    }
    std::size_t const first = a / BoxList::kBoxesAtOnce * BoxList::kBoxesAtOnce;
    for (std::size_t begin = first; begin < block_count; begin += BoxList::kBoxesAtOnce) {
      std::uint32_t near = boxes_in_reach(blocks, a, blocks, begin, reach_);
      for (; near != 0; near &= near - 1) {
        std::size_t const b = begin + static_cast<std::size_t>(std::countr_zero(near));
        if (b >= a && b < block_count) {
          unite_blocks(blocks, a, b);
        }
      }
      if (pairs_.pixel_searches() > budget) {
        drop_finished_groups();
        budget = 2 * pairs_.pixel_searches();
      }
    }
  }
}

}  // namespace

void unite_all_in_reach(PointArrays const& points, LinkBits const& links,
                        std::vector<Run> const& runs, ReachThresholds const& reach,
                        DisjointSets& sets) {
  TileSearch search(points, links, runs, reach, sets);
  search.unite_near_tiles();
  search.drop_finished_groups();
  search.unite_far_tiles();
}

}  // namespace credo::reachability
