#include "stages/fusion/stuff/shown_steps.hpp"

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
  auto const width = static_cast<std::size_t>(owners.width());
  for (std::size_t place = 0; place < owners.size(); ++place) {
    if ((place + 1) % width != 0) {
      compare(place, place + 1);
    }
    if (place + width < owners.size()) {
      compare(place, place + width);
    }
  }
}

bool ShownSteps::stand_apart(std::size_t a, std::size_t b) const {
  auto const found = borders_.find(
      {static_cast<std::int32_t>(std::min(a, b)), static_cast<std::int32_t>(std::max(a, b))});
  return found != borders_.end() && 2 * found->second.steps > found->second.blocks;
}

}  // namespace credo
