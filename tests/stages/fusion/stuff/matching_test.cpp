#include "stages/fusion/stuff/matching.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "stages/fusion/scenes.hpp"
#include "support/literal_fusion.hpp"

namespace credo {
namespace {

using test::box_cluster;
using test::cluster_of;
using testing::ElementsAre;
using testing::Eq;
using testing::IsEmpty;

using Matches = std::vector<std::optional<std::size_t>>;

Matches matches(std::vector<StuffCluster> const& known, std::vector<StuffCluster> const& seen,
                StuffFusionConfig const& config = {}) {
  std::vector<StuffCluster const*> pointers;
  pointers.reserve(known.size());
  for (StuffCluster const& cluster : known) {
    pointers.push_back(&cluster);
  }
  return match_clusters(pointers, seen, config);
}

Eigen::Vector3f const kMugSize(0.08F, 0.08F, 0.1F);

TEST(MatchClusters, FindsEachThingAgainThatMovedALittle) {
  std::vector<StuffCluster> const known = {box_cluster(4000, {0, 0, 0}, kMugSize),
                                           box_cluster(4001, {0.13F, 0, 0}, {0.1F, 0.2F, 0.2F})};
  std::vector<StuffCluster> const seen = {box_cluster(4000, {0.14F, 0.01F, 0}, {0.1F, 0.2F, 0.2F}),
                                          box_cluster(4001, {0.02F, 0.01F, 0}, kMugSize)};
  EXPECT_THAT(matches(known, seen), ElementsAre(Eq(1U), Eq(0U)));
  EXPECT_THAT(matches(known, seen, test::thesis_config().stuff), ElementsAre(Eq(1U), Eq(0U)));
}

TEST(MatchClusters, NeedsBoxesThatOverlapWithinTheMargin) {
  std::vector<StuffCluster> const known = {box_cluster(4000, {0, 0, 0}, kMugSize)};
  EXPECT_THAT(matches(known, {box_cluster(4000, {0.099F, 0, 0}, kMugSize)}), ElementsAre(Eq(0U)));
  EXPECT_THAT(matches(known, {box_cluster(4000, {0.101F, 0, 0}, kMugSize)}),
              ElementsAre(std::nullopt));
}

TEST(MatchClusters, NeedsBothToBeEachOthersBest) {
  // Both seen mugs fit the known one, which fits the nearer one better.
  std::vector<StuffCluster> const known = {box_cluster(4000, {0, 0, 0}, kMugSize)};
  StuffCluster const dented = [] {
    PointList points = box_cluster(4001, {0.01F, 0, 0}, kMugSize).points_world;
    for (std::size_t i = 0; i < points.size(); i += 3) {
      points[i].z() += 0.015F;
    }
    return cluster_of(4001, points);
  }();
  std::vector<StuffCluster> const seen = {dented, box_cluster(4000, {0.02F, 0, 0}, kMugSize)};
  EXPECT_THAT(matches(known, seen), ElementsAre(Eq(1U)));
  // The other way round: one seen, two that might be it; the second known one fits exactly.
  std::vector<StuffCluster> const& two = seen;
  std::vector<StuffCluster> const& one = known;
  EXPECT_THAT(matches(two, one), ElementsAre(std::nullopt, Eq(0U)));
}

TEST(MatchClusters, GivesATieToTheLowerLabelAndTheEarlierKnown) {
  StuffCluster const mug = box_cluster(4005, {0, 0, 0}, kMugSize);
  StuffCluster lower = mug;
  lower.label = 4002;
  EXPECT_THAT(matches({mug}, {mug, lower}), ElementsAre(Eq(1U)));
  EXPECT_THAT(matches({mug, mug}, {mug}), ElementsAre(Eq(0U), std::nullopt));
  // All four pairs tie: only the first known one and the lower label are each other's best.
  EXPECT_THAT(matches({mug, mug}, {mug, lower}), ElementsAre(Eq(1U), std::nullopt));
}

TEST(MatchClusters, AFragmentTakesTheWholesPlace) {
  // A thing, dented a little since, and a splinter of its old surface.
  StuffCluster const whole = box_cluster(4000, {0, 0, 0}, kMugSize);
  PointList dented = whole.points_world;
  PointList splinter;
  for (std::size_t i = 0; i < dented.size(); ++i) {
    if (dented[i].x() < 0.03F && dented[i].z() < 0.05F) {
      splinter.push_back(dented[i]);
    }
    dented[i].y() += i % 3 == 0 ? 0.01F : 0.0F;
  }
  std::vector<StuffCluster> const seen = {cluster_of(4000, dented), cluster_of(4001, splinter)};
  // Of so few points the sum of squared distances is small.
  EXPECT_THAT(matches({whole}, seen, test::thesis_config().stuff), ElementsAre(Eq(1U)));
}

TEST(MatchClusters, DoesNotTakeAPartForTheWholeWhereItIsLimited) {
  // A box on a cupboard front: all of its points lie near the front, but not the other way round.
  PointList front;
  for (int i = 0; i <= 50; ++i) {
    for (int j = 0; j <= 50; ++j) {
      front.emplace_back(0.02F * static_cast<float>(i), 0.0F, 0.02F * static_cast<float>(j));
    }
  }
  std::vector<StuffCluster> const known = {cluster_of(4000, front)};
  std::vector<StuffCluster> const seen = {box_cluster(4000, {0.4F, 0, 0.4F}, kMugSize)};
  EXPECT_THAT(matches(known, seen), ElementsAre(std::nullopt));
  // The thesis has no limits: the only candidates are each other's best.
  EXPECT_THAT(matches(known, seen, test::thesis_config().stuff), ElementsAre(Eq(0U)));
}

TEST(MatchClusters, FindsLargeThingsThatAreThinnedDifferently) {
  // A front of 1 x 2 m, and again with its edge out of view, which takes other cells of the grid.
  auto const front = [](int columns, float shift) {
    PointList points;
    for (int i = 0; i <= columns; ++i) {
      for (int j = 0; j <= 100; ++j) {
        points.emplace_back(0.02F * static_cast<float>(i) + shift, shift,
                            0.02F * static_cast<float>(j) + shift);
      }
    }
    return cluster_of(4000, points);
  };
  StuffFusionConfig config;
  EXPECT_THAT(matches({front(50, 0.0F)}, {front(47, 0.013F)}, config), ElementsAre(Eq(0U)));
  // What the thinning alone brings about is not held against the pair.
  config.max_rms_m = 0.001;
  EXPECT_THAT(matches({front(50, 0.0F)}, {front(47, 0.013F)}, config), ElementsAre(Eq(0U)));
}

TEST(MatchClusters, TakesNothingAndDegenerateClusters) {
  StuffCluster const mug = box_cluster(4000, {0, 0, 0}, kMugSize);
  EXPECT_THAT(matches({}, {mug}), IsEmpty());
  EXPECT_THAT(matches({mug}, {}), ElementsAre(std::nullopt));
  EXPECT_THAT(matches({mug}, {StuffCluster{}}), ElementsAre(std::nullopt));
  StuffCluster const point = cluster_of(4000, {{0, 0, 0}});
  EXPECT_THAT(matches({point}, {point}), ElementsAre(Eq(0U)));
}

/// Boxes crowded enough that many boxes overlap, small enough not to be thinned.
struct CrowdedScene {
  std::vector<StuffCluster> known;
  std::vector<StuffCluster> seen;
};

CrowdedScene crowded_scene(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(0.0F, 0.5F);
  std::uniform_real_distribution<float> size(0.04F, 0.12F);
  std::normal_distribution<float> noise(0.0F, 0.003F);
  std::normal_distribution<float> shift(0.0F, 0.01F);
  CrowdedScene scene;
  for (int i = 0; i < 12; ++i) {
    Eigen::Vector3f const corner(place(random), place(random), 0.0F);
    Eigen::Vector3f const extent(size(random), size(random), size(random));
    Eigen::Vector3f const moved(shift(random), shift(random), 0.0F);
    auto const label = static_cast<LabelCode>(4000 + i);
    auto const noisy = [&](Eigen::Vector3f const& offset) {
      PointList points = box_cluster(label, corner + offset, extent).points_world;
      points.resize(std::min<std::size_t>(points.size(), 128));
      for (Eigen::Vector3f& p : points) {
        p += Eigen::Vector3f(noise(random), noise(random), noise(random));
      }
      return cluster_of(label, points);
    };
    if (i != 3) {
      scene.known.push_back(noisy({0, 0, 0}));
    }
    if (i != 7) {
      scene.seen.push_back(noisy(moved));
    }
  }
  std::shuffle(scene.seen.begin(), scene.seen.end(), random);
  return scene;
}

TEST(MatchClusters, AgreesWithTheLiteralAlgorithm) {
  StuffFusionConfig thesis = test::thesis_config().stuff;
  StuffFusionConfig limited;
  std::size_t matched = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    CrowdedScene const scene = crowded_scene(seed);
    for (StuffFusionConfig config : {thesis, limited}) {
      // No cluster here has more: the literal algorithm knows no thinning.
      config.max_icp_points = 128;
      // To the fixed point, where both kinds of arithmetic must arrive.
      config.min_icp_step_m = 0.0;
      config.max_icp_iterations = 50;
      Matches const found = matches(scene.known, scene.seen, config);
      EXPECT_EQ(found, test::literal_matches(scene.known, scene.seen, config)) << seed;
      matched += static_cast<std::size_t>(
          std::count_if(found.begin(), found.end(), [](auto const& m) { return m.has_value(); }));
    }
  }
  EXPECT_GT(matched, 100U);
}

TEST(MatchClusters, DoesNotDependOnTheOrderOfTheSeen) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    CrowdedScene scene = crowded_scene(seed);
    Matches const found = matches(scene.known, scene.seen);
    std::vector<StuffCluster> reversed(scene.seen.rbegin(), scene.seen.rend());
    Matches const found_reversed = matches(scene.known, reversed);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].has_value(), found_reversed[i].has_value());
      if (found[i]) {
        EXPECT_EQ(scene.seen[*found[i]].label, reversed[*found_reversed[i]].label);
      }
    }
  }
}

}  // namespace
}  // namespace credo
