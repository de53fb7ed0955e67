#include "geometry/reachability/runs.hpp"

#include <algorithm>
#include <bit>

namespace credo::reachability {
namespace {

constexpr unsigned kWordBits = 64;

// Is any of the bits begin ... end - 1 of the row set?
bool any_bit(std::uint64_t const* row, int begin, int end) {
  if (begin >= end) {
    return false;
  }
  auto const first = static_cast<unsigned>(begin);
  auto const last = static_cast<unsigned>(end) - 1;
  std::uint64_t const from_first = ~std::uint64_t{0} << (first % kWordBits);
  std::uint64_t const to_last = ~std::uint64_t{0} >> (kWordBits - 1 - last % kWordBits);
  unsigned word = first / kWordBits;
  if (word == last / kWordBits) {
    return (row[word] & from_first & to_last) != 0;
  }
  if ((row[word] & from_first) != 0) {
    return true;
  }
  for (++word; word < last / kWordBits; ++word) {
    if (row[word] != 0) {
      return true;
    }
  }
  return (row[word] & to_last) != 0;
}

// Does a link join the run `below` to the run `above`, one row up?
bool linked(LinkBits const& links, Run const& above, Run const& below) {
  return any_bit(links.up.row(below.v), std::max(above.begin, below.begin),
                 std::min(above.end, below.end)) ||
         any_bit(links.rising.row(below.v), std::max(above.begin - 1, below.begin),
                 std::min(above.end - 1, below.end)) ||
         any_bit(links.falling.row(below.v), std::max(above.begin, below.begin - 1),
                 std::min(above.end, below.end - 1));
}

}  // namespace

std::vector<Run> find_runs(LinkBits const& links, int height) {
  std::vector<Run> runs;
  std::size_t const words = links.usable.words();
  for (int v = 0; v < height; ++v) {
    std::uint64_t const* usable = links.usable.row(v);
    std::uint64_t const* right = links.right.row(v);
    std::size_t last_of_run = runs.size();
    std::uint64_t joined_before = 0;  // bit 0: the word's first pixel continues a run
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t const next = w + 1 < words ? usable[w + 1] : 0;
      std::uint64_t const joined =
          right[w] & usable[w] & ((usable[w] >> 1) | (next << (kWordBits - 1)));
      int const u = static_cast<int>(w * kWordBits);
      std::uint64_t starts = usable[w] & ~((joined << 1) | joined_before);
      for (; starts != 0; starts &= starts - 1) {
        runs.push_back({.v = v, .begin = u + std::countr_zero(starts)});
      }
      for (std::uint64_t lasts = usable[w] & ~joined; lasts != 0; lasts &= lasts - 1) {
        runs[last_of_run++].end = u + std::countr_zero(lasts) + 1;
      }
      joined_before = joined >> (kWordBits - 1);
    }
  }
  return runs;
}

void unite_linked_runs(LinkBits const& links, std::vector<Run> const& runs, DisjointSets& sets) {
  std::size_t above = 0;  // first run that may touch the current one
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Run const& run = runs[i];
    while (runs[above].v < run.v - 1 ||
           (runs[above].v == run.v - 1 && runs[above].end < run.begin)) {
      ++above;
    }
    for (std::size_t j = above; runs[j].v == run.v - 1 && runs[j].begin <= run.end; ++j) {
      if (linked(links, runs[j], run)) {
        sets.unite(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
      }
    }
  }
}

}  // namespace credo::reachability
