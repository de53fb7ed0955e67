#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/reachability/runs.hpp"

namespace credo::reachability {

/// The pixels of one tile that belong to one component.
struct Group {
  TilePixels pixels;
  /// The component's root when the groups were last joined.
  std::int32_t root = 0;
  // Bounds are found when they are first needed.
  bool has_points = false;
  bool has_normals = false;
  Box points;
  Box normals;
};

/// All groups, tile by tile.
class TileGroups {
public:
  /// `sets` are those of the runs.
  TileGroups(int width, LinkBits const& links, std::vector<Run> const& runs, DisjointSets& sets);

  [[nodiscard]] std::size_t tile_count() const { return ranges_.size(); }
  [[nodiscard]] std::size_t occupied_tile_count() const;
  [[nodiscard]] std::size_t group_count() const;
  [[nodiscard]] std::span<Group> of_tile(std::size_t tile) {
    return std::span(groups_).subspan(ranges_[tile].begin, ranges_[tile].end - ranges_[tile].begin);
  }
  /// Makes one group of those of a tile that have become one component, and tells `tiles` the range
  /// of its components.
  void join(std::size_t tile, DisjointSets& sets, BoxList& tiles);
  /// Forgets the groups of a tile for which `finished` is true.
  template <typename Finished>
  void erase_if(std::size_t tile, Finished const& finished) {
    std::span<Group> const groups = of_tile(tile);
    auto const gone = std::remove_if(groups.begin(), groups.end(), finished);
    ranges_[tile].end -= static_cast<std::size_t>(groups.end() - gone);
  }

private:
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  std::vector<Group> groups_;
  std::vector<Range> ranges_;
};

/// Finds and unites groups that hold neighbours.
class GroupPairs {
public:
  GroupPairs(PointArrays const& points, LinkBits const& links, ReachThresholds const& reach,
             DisjointSets& sets);

  /// All pairs of a group of one tile and a group of the other.
  void unite(std::span<Group> a, std::span<Group> b);
  /// All pairs of groups of one tile.
  void unite(std::span<Group> groups);
  /// How many pairs of tiles were searched pixel by pixel so far.
  [[nodiscard]] std::size_t pixel_searches() const { return pixel_searches_; }
  /// No point of a can be a neighbour of any of b, for all that their bounds tell; both must have
  /// been found.
  [[nodiscard]] bool apart(Group const& a, Group const& b) const;
  Box const& points_of(Group& group) const;
  Box const& normals_of(Group& group) const;

private:
  void unite(Group& a, Group& b);
  void unite_pixels(std::span<Group const> a, std::span<Group const> b);

  PointArrays points_;
  ReachThresholds reach_;
  DisjointSets& sets_;
  std::size_t pixel_searches_ = 0;
  float max_squared_turn_ = 0.0F;
  float sure_squared_turn_ = 0.0F;
};

}  // namespace credo::reachability
