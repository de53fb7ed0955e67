#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "core/grid.hpp"
#include "core/sight.hpp"

namespace credo {

/// Where two things show side by side in one cluster of a frame: whether one stands behind the
/// other there.
class ShownSteps {
public:
  /// `owners`: of each block the thing that fits it best, by its place in the belief; -1 for none.
  ShownSteps(Sight const& sight, Grid<std::int32_t> const& owners);

  /// Whether the depth leaps between most of the neighbouring blocks of which one is the one
  /// thing's and the other, in the same cluster, the other's: by more than a thing may be off to
  /// agree with what is measured (agreement_m). False where they have no such blocks.
  [[nodiscard]] bool stand_apart(std::size_t a, std::size_t b) const;

private:
  /// Pairs of neighbouring blocks.
  struct Border {
    int blocks = 0;
    int steps = 0;
  };
  /// By the two things, the first one first.
  std::map<std::pair<std::int32_t, std::int32_t>, Border> borders_;
};

}  // namespace credo
