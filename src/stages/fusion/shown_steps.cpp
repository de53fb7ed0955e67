#include "stages/fusion/shown_steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/label.hpp"
#include "stages/fusion/sight_view.hpp"

namespace credo {

ShownSteps::ShownSteps(Sight const& sight, Grid<std::int32_t> const& owners) {
  auto const compare = [&](std::size_t one, std::size_t next) {
    std::int32_t const a = owners[one];
    std::int32_t const b = owners[next];
    if (a == b || a < 0 || b < 0 || sight.labels[one] != sight.labels[next] ||
        !is_stuff(sight.labels[one])) {
      return;
    }
    float const near_m = std::min(sight.depth_m[one], sight.depth_m[next]);
    float const step_m = std::abs(sight.depth_m[one] - sight.depth_m[next]);
    Border& border = borders_[std::minmax(a, b)];
    ++border.blocks;
    border.steps += step_m > agreement_m(near_m) ? 1 : 0;
  };
  for (int v = 0; v < owners.height(); ++v) {
    for (int u = 0; u < owners.width(); ++u) {
      if (u + 1 < owners.width()) {
        compare(owners.index({u, v}), owners.index({u + 1, v}));
      }
      if (v + 1 < owners.height()) {
        compare(owners.index({u, v}), owners.index({u, v + 1}));
      }
    }
  }
}

bool ShownSteps::stand_apart(std::size_t a, std::size_t b) const {
  auto const found = borders_.find(
      {static_cast<std::int32_t>(std::min(a, b)), static_cast<std::int32_t>(std::max(a, b))});
  return found != borders_.end() && 2 * found->second.steps > found->second.blocks;
}

}  // namespace credo
