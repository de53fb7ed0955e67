#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/belief.hpp"
#include "stages/fusion/stuff/items.hpp"
#include "stages/fusion/stuff/known_places.hpp"
#include "stages/fusion/stuff/moves.hpp"
#include "stages/fusion/stuff/table_views.hpp"

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
    // Not seen, but moved: what is there is floor, wall or known object; or it was on its way.
    bool const may_move = item.evidence == Evidence::kNotSeen || is_on_its_way(item);
    if (same == before.end() || (!told && !may_move)) {
      EXPECT_EQ(item.why.moved, 0.0) << item.id;
    }
    EXPECT_TRUE(item.why.news > 0.0 || !told) << item.id;
    EXPECT_GE(item.why.visible_share, 0.0);
    EXPECT_LE(item.why.visible_share, 1.0);
  }
}

/// Whether a room remembers what the frame before saw through.
enum RoomKind : std::uint8_t { kWithoutSight, kWithSight };

/// A belief that is shown one view after the other, at 30 Hz.
class Room {
public:
  /// Whatever is seen first is believed with `born`, but what arrives with 0.9 at most.
  explicit Room(RoomKind kind = kWithoutSight, double born = 0.7) : kind_(kind) {
    config_.births = {.log_odds = log_odds_of(born), .per_log_thickness = 0.0};
  }

  FusedStuff const& show(View view, int times = 1) {
    for (int k = 0; k < times; ++k) {
      view.stamp_ns = kFrame_ns * frame_++;
      std::vector<StuffBelief> const before = stuff_.stuff;
      Segmentation const frame = segmentation_of(view);
      surroundings_.T_world_camera = frame.T_world_camera;
      stuff_ = fused_items(std::move(stuff_), frame, KnownPlaces(surroundings_, {}),
                           1e-9 * kFrame_ns, config_);
      if (kind_ == kWithSight) {
        surroundings_.last_sight =
            std::make_shared<PlacedSight const>(PlacedSight{frame.sight, frame.T_world_camera});
      }
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
  RoomKind kind_;
  BeliefState surroundings_;
  FusionConfig config_;
  FusedStuff stuff_;
  std::int64_t frame_ = 0;
};

}  // namespace credo::test
