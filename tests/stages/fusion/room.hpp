#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/belief.hpp"
#include "stages/fusion/known_places.hpp"
#include "stages/fusion/stuff_items.hpp"
#include "stages/fusion/table_views.hpp"

// A belief about stuff that hand-made frames are shown to.
namespace credo::test {

inline constexpr std::int64_t kFrame_ns = 33'333'333;

/// What each thing's account says is what happened to its log-odds; nothing of a thing is told
/// unless it is seen or seen through.
inline void expect_accounted(std::vector<StuffBelief> const& before,
                             std::vector<StuffBelief> const& after) {
  for (StuffBelief const& item : after) {
    auto const same = std::ranges::find(before, item.id, &StuffBelief::id);
    double const was = same == before.end() ? item.log_odds : same->log_odds;
    EXPECT_NEAR(item.log_odds, was + item.why.moved, 1e-12) << item.id;
    bool const told = item.evidence == Evidence::kSeen || item.evidence == Evidence::kSeenThrough;
    // Not seen, but moved: what is there is floor, wall or known object.
    if (same == before.end() || (!told && item.evidence != Evidence::kNotSeen)) {
      EXPECT_EQ(item.why.moved, 0.0) << item.id;
    }
    EXPECT_TRUE(item.why.news > 0.0 || !told) << item.id;
    EXPECT_GE(item.why.visible_share, 0.0);
    EXPECT_LE(item.why.visible_share, 1.0);
  }
}

/// A belief that is shown one view after the other, at 30 Hz.
class Room {
public:
  FusedStuff const& show(View view, int times = 1) {
    for (int k = 0; k < times; ++k) {
      view.stamp_ns = kFrame_ns * frame_++;
      std::vector<StuffBelief> const before = stuff_.stuff;
      stuff_ = fused_items(std::move(stuff_), segmentation_of(view), KnownPlaces({}, {}), config_);
      expect_accounted(before, stuff_.stuff);
    }
    return stuff_;
  }
  [[nodiscard]] std::vector<StuffBelief> const& stuff() const { return stuff_.stuff; }
  [[nodiscard]] std::vector<std::uint32_t> ids() const {
    std::vector<std::uint32_t> ids;
    for (StuffBelief const& item : stuff_.stuff) {
      ids.push_back(item.id);
    }
    return ids;
  }

private:
  /// Whatever is seen first is believed with 0.7.
  static FusionConfig config_with_equal_births() {
    FusionConfig config;
    config.births = {.log_odds = std::log(0.7 / 0.3), .per_log_thickness = 0.0};
    return config;
  }

  FusionConfig config_ = config_with_equal_births();
  FusedStuff stuff_;
  std::int64_t frame_ = 0;
};

}  // namespace credo::test
