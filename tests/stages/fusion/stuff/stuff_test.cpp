#include "stages/fusion/stuff/stuff.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "core/cloud.hpp"
#include "stages/fusion/scenes.hpp"

namespace credo {
namespace {

using test::box_cluster;
using test::thesis_config;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::Eq;
using testing::IsEmpty;
using testing::SizeIs;

StuffCluster mug(LabelCode label, float x) {
  return box_cluster(label, {x, 0, 0}, {0.08F, 0.08F, 0.1F});
}

/// The probability after each frame; a frame shows the mug or it does not. Ends when it is gone.
std::vector<double> history(std::vector<bool> const& seen) {
  FusedStuff stuff;
  std::vector<double> probabilities;
  for (bool const shows : seen) {
    stuff = fused_stuff(std::move(stuff),
                        shows ? std::vector{mug(4000, 0)} : std::vector<StuffCluster>{}, {},
                        thesis_config());
    if (stuff.stuff.empty()) {
      break;
    }
    probabilities.push_back(probability_of(stuff.stuff[0].log_odds));
  }
  return probabilities;
}

TEST(FusedStuff, FadesAsInTheThesisWhenSeenOnce) {
  // 0.014 would be next, below 0.15: gone at the third miss.
  EXPECT_THAT(
      history({true, false, false, false, false}),
      ElementsAre(DoubleNear(0.99, 5e-4), DoubleNear(0.839, 5e-4), DoubleNear(0.215, 5e-4)));
  EXPECT_NEAR(probability_of(log_odds_of(0.99) - 3 * log_odds_of(0.95)), 0.014, 5e-4);
}

TEST(FusedStuff, FadesAsInTheThesisWhenSeenTwice) {
  EXPECT_THAT(
      history({true, true, false, false, false, false, false}),
      ElementsAre(DoubleNear(0.99, 5e-4), DoubleNear(0.99947, 5e-6), DoubleNear(0.990, 5e-4),
                  DoubleNear(0.839, 5e-4), DoubleNear(0.215, 5e-4)));
}

TEST(FusedStuff, TheAccountIsWhatMovedLogOdds) {
  FusionConfig config;
  config.existence.max_log_odds = 5.2;
  FusedStuff stuff = fused_stuff({}, {mug(4000, 0)}, {}, config);
  EXPECT_EQ(stuff.stuff[0].why.moved, 0.0);
  EXPECT_EQ(stuff.stuff[0].why.news, 1.0);
  double const first = stuff.stuff[0].log_odds;
  ViewChange change;
  change.elapsed_s = 0.1;
  change.camera_before_world = change.camera_now_world = {5, 0, 0};
  double const news = 1.0 - std::exp(-0.1 / 0.25);
  stuff = fused_stuff(std::move(stuff), {mug(4000, 0)}, change, config);
  EXPECT_NEAR(stuff.stuff[0].why.news, news, 1e-12);
  EXPECT_EQ(stuff.stuff[0].log_odds, first + stuff.stuff[0].why.moved);
  EXPECT_FALSE(stuff.stuff[0].why.bounded);
  double const second = stuff.stuff[0].log_odds;
  stuff = fused_stuff(std::move(stuff), {mug(4000, 0)}, change, config);
  EXPECT_TRUE(stuff.stuff[0].why.bounded);
  EXPECT_NEAR(stuff.stuff[0].why.moved, 5.2 - second, 1e-12);
  // Not seen after seen: news in full.
  stuff = fused_stuff(std::move(stuff), {}, change, config);
  EXPECT_EQ(stuff.stuff[0].why.news, 1.0);
  EXPECT_NEAR(stuff.stuff[0].why.moved, -std::log(0.95 / 0.05), 1e-12);
  EXPECT_FALSE(stuff.stuff[0].why.bounded);
}

TEST(FusedStuff, GrowsAHistoryThatIsCountedInFullAndKeptInPart) {
  FusionConfig const config;
  FusedStuff stuff;
  for (int i = 0; i < 10; ++i) {
    auto const label = static_cast<LabelCode>(4000 + i);
    stuff = fused_stuff(std::move(stuff), {mug(label, 0.001F * static_cast<float>(i))}, {}, config);
  }
  ASSERT_THAT(stuff.stuff, SizeIs(1));
  StuffBelief const& item = stuff.stuff[0];
  EXPECT_EQ(item.id, 1U);
  EXPECT_EQ(item.history_count, 10U);
  ASSERT_THAT(item.recent_clusters, SizeIs(3));
  EXPECT_EQ(item.recent_clusters[0]->label, 4007);
  EXPECT_EQ(item.latest().label, 4009);
  EXPECT_EQ(item.label, LabelCode{4009});
}

TEST(FusedStuff, TellsWhatItSawOfEachThing) {
  FusedStuff stuff = fused_stuff({}, {mug(4000, 0), mug(4001, 1)}, {}, {});
  stuff = fused_stuff(std::move(stuff), {mug(4000, 1), mug(4001, 2)}, {}, {});
  ASSERT_THAT(stuff.stuff, SizeIs(3));
  EXPECT_EQ(stuff.stuff[0].evidence, Evidence::kNotSeen);
  EXPECT_THAT(stuff.stuff[0].label, Eq(std::nullopt));
  EXPECT_EQ(stuff.stuff[0].history_count, 1U);
  EXPECT_EQ(stuff.stuff[1].evidence, Evidence::kSeen);
  EXPECT_EQ(stuff.stuff[1].label, LabelCode{4000});
  EXPECT_EQ(stuff.stuff[2].id, 3U);
  EXPECT_EQ(stuff.stuff[2].evidence, Evidence::kSeen);
}

TEST(FusedStuff, NeverUsesAnIdTwice) {
  FusedStuff stuff;
  for (int i = 0; i < 20; ++i) {
    bool const shows = i % 5 == 0;
    stuff = fused_stuff(std::move(stuff),
                        shows ? std::vector{mug(4000, 0)} : std::vector<StuffCluster>{}, {},
                        thesis_config());
    EXPECT_THAT(stuff.stuff, SizeIs(i % 5 < 3 ? 1 : 0));
  }
  EXPECT_EQ(stuff.next_id, 5U);
}

TEST(FusedStuff, SharesTheClustersOfAHistory) {
  FusedStuff const before = fused_stuff({}, {mug(4000, 0)}, {}, {});
  FusedStuff const after = fused_stuff(before, {mug(4000, 0)}, {}, {});
  EXPECT_EQ(after.stuff[0].recent_clusters[0], before.stuff[0].recent_clusters[0]);
  EXPECT_THAT(before.stuff[0].recent_clusters, SizeIs(1));
}

TEST(FusedStuff, PassesOverClustersThatShowNothing) {
  StuffCluster no_centroid = mug(4000, 0);
  no_centroid.centroid_world.x() = kNaN;
  EXPECT_THAT(fused_stuff({}, {StuffCluster{}, no_centroid}, {}, {}).stuff, IsEmpty());
}

}  // namespace
}  // namespace credo
