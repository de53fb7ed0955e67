#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/object_model.hpp"
#include "sim/tabletop_maker.hpp"

namespace credo {

/// A set of made scenes: `count` of one kind, with seeds one after the other.
struct TabletopSet {
  std::string_view name;
  TabletopKind kind;
  int first_seed;
  int count;
};

/// Those to measure on, and smaller ones of other seeds to tune on.
inline constexpr std::array<TabletopSet, 4> kTabletopSets = {{
    {"kinect", TabletopKind::kSparse, 1000, 50},
    {"clutter", TabletopKind::kClutter, 2000, 20},
    {"tuning-kinect", TabletopKind::kSparse, 9000, 8},
    {"tuning-clutter", TabletopKind::kClutter, 9500, 4},
}};

/// None for another name.
[[nodiscard]] std::optional<TabletopSet> tabletop_set(std::string_view name);

/// Makes its scenes anew.
[[nodiscard]] std::vector<TabletopScene> make_scenes(TabletopSet const& set,
                                                     ObjectModels const& models);

}  // namespace credo
