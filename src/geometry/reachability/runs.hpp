#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "geometry/reachability/kernels.hpp"

namespace credo::reachability {

/// Disjoint sets of 0 ... count - 1; each set is named by its smallest member, its root.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t root(std::int32_t i) {
    while (parent(i) != i) {
      parent(i) = parent(parent(i));
      i = parent(i);
    }
    return i;
  }
  void unite(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    parent(std::max(a, b)) = std::min(a, b);
  }

private:
  std::int32_t& parent(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<std::int32_t> parent_;
};

/// Usable pixels (begin, v) ... (end - 1, v), each a neighbour of the one before.
struct Run {
  int v = 0;
  int begin = 0;
  int end = 0;
};

/// The longest runs, in raster order.
[[nodiscard]] std::vector<Run> find_runs(LinkBits const& links, int height);

/// Unites runs of adjacent rows that any link joins.
void unite_linked_runs(LinkBits const& links, std::vector<Run> const& runs, DisjointSets& sets);

}  // namespace credo::reachability
