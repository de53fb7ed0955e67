#include "stages/fusion/stuff/looks.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "stages/fusion/sight_view.hpp"
#include "stages/fusion/stuff/model.hpp"
#include "stages/fusion/stuff/table_views.hpp"

namespace credo {
namespace {

using test::Board;
using test::View;

constexpr LabelCode kFirst = kFirstStuff;
constexpr LabelCode kSecond = kFirstStuff + 1;

/// A thing with a point every 2 cm of a square of 20 cm, `z_m` away.
StuffBelief square(double left_m, double z_m) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 100; ++i) {
    points.emplace_back(static_cast<float>(left_m) + 0.02F * (static_cast<float>(i % 10) + 0.5F),
                        0.02F * (static_cast<float>(i / 10) + 0.5F), static_cast<float>(z_m));
  }
  StuffBelief item;
  item.model = std::make_shared<StuffModel const>(new_model(points, 0.25));
  item.recent_clusters = {
      std::make_shared<StuffCluster const>(cluster_of(*item.model, kFirst, points.size()))};
  return item;
}

StuffLook look(View const& view, StuffBelief const& item) {
  Segmentation const frame = test::segmentation_of(view);
  return StuffLooks(frame.sight, frame.T_world_camera, {item}).looks()[0];
}

/// The table of docs/belief.md, case by case.
PointState plain_state_of(float point_m, float measured_m, float nearest_m) {
  float const tolerance_m = 0.01F + 0.01F * point_m;
  if (!(measured_m > 0.0F)) {
    return PointState::kUnmeasured;
  }
  if (measured_m > point_m - tolerance_m && measured_m < point_m + tolerance_m) {
    return PointState::kAgrees;
  }
  return nearest_m > point_m + tolerance_m ? PointState::kSeenThrough : PointState::kOccluded;
}

TEST(StuffLooks, ThePlainRuleSaysTheSameOfAPoint) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> const depths_m = {-1.0F, 0.0F, 0.5F,  0.97F, 0.98F, 1.0F, 1.02F, 1.03F,
                                       2.96F, 3.0F, 3.04F, 3.05F, 5.0F,  9.0F, kNan,  kInfinity};
  for (float const point_m : {0.5F, 1.0F, 3.0F}) {
    for (float const measured_m : depths_m) {
      for (float const nearest_m : depths_m) {
        EXPECT_EQ(state_of(point_m, measured_m, nearest_m),
                  plain_state_of(point_m, measured_m, nearest_m))
            << point_m << " " << measured_m << " " << nearest_m;
      }
    }
  }
}

TEST(StuffLooks, WhatIsThereAgrees) {
  StuffLook const seen = look({.boards = {{kFirst}}}, square(0, 1.5));
  EXPECT_EQ(seen.counts[PointState::kAgrees], 100);
  ASSERT_EQ(seen.shares.size(), 1U);
  EXPECT_EQ(seen.shares[0].label, kFirst);
  EXPECT_EQ(seen.shares[0].agreeing, 100);
  // A pixel is a centimetre there, and a point stands for the 2 cm around it.
  EXPECT_EQ(seen.shares[0].blocks, 400);
  EXPECT_EQ(seen.blocks, 400);
  EXPECT_EQ(seen.shares[0].agreement(), 1.0);
}

TEST(StuffLooks, WhatIsNearlyThereAgrees) {
  EXPECT_EQ(look({.boards = {{kFirst}}}, square(0, 1.522)).counts[PointState::kAgrees], 100);
  EXPECT_EQ(look({.boards = {{kFirst}}}, square(0, 1.478)).counts[PointState::kAgrees], 100);
  EXPECT_EQ(look({.boards = {{kFirst}}}, square(0, 1.53)).counts[PointState::kAgrees], 0);
}

TEST(StuffLooks, WhatIsGoneIsSeenThrough) {
  EXPECT_EQ(look({}, square(0, 1.5)).counts[PointState::kSeenThrough], 100);
}

TEST(StuffLooks, WhatStandsInFrontHides) {
  Board const in_front{kSecond, 0.0, 0.0, 0.2, 0.2, 1.0};
  StuffLook const seen = look({.boards = {{kFirst}, in_front}}, square(0, 1.5));
  EXPECT_EQ(seen.counts[PointState::kAgrees], 0);
  EXPECT_EQ(seen.counts[PointState::kSeenThrough], 0);
  EXPECT_EQ(seen.counts[PointState::kOccluded], 100);
  ASSERT_EQ(seen.shares.size(), 1U);
  EXPECT_EQ(seen.shares[0].label, kSecond);
  EXPECT_EQ(seen.shares[0].hidden, 100);
  EXPECT_EQ(seen.shares[0].agreement(), 0.0);
}

// At an edge, a pose that is not quite right looks past a thing that is there.
TEST(StuffLooks, BesideWhatIsThereNothingIsSeenThrough) {
  StuffLook const seen = look({.boards = {{kFirst, 0.02}}}, square(0, 1.5));
  EXPECT_EQ(seen.counts[PointState::kSeenThrough], 0);
  EXPECT_EQ(seen.counts[PointState::kOccluded], 10);
}

TEST(StuffLooks, WithoutDepthNothingIsTold) {
  StuffLook const seen = look({.boards = {{kFirst}}, .blind_px = 120}, square(0, 1.5));
  EXPECT_EQ(seen.counts[PointState::kUnmeasured], 100);
  EXPECT_TRUE(seen.shares.empty());
  EXPECT_EQ(seen.blocks, 0);
}

TEST(StuffLooks, OutOfViewNothingIsTold) {
  EXPECT_EQ(look({.x_m = 2.0}, square(0, 1.5)).counts[PointState::kOutOfView], 100);
  EXPECT_EQ(look({}, square(0, -1.5)).counts[PointState::kOutOfView], 100);
}

/// The same thing with such bounds that all its points are looked at, wherever they are.
StuffBelief without_bounds(StuffBelief item) {
  StuffCluster cluster = item.latest();
  cluster.bounds_world.extend(Eigen::Vector3f(-50.0F, -50.0F, -50.0F));
  cluster.bounds_world.extend(Eigen::Vector3f(50.0F, 50.0F, 50.0F));
  item.recent_clusters = {std::make_shared<StuffCluster const>(std::move(cluster))};
  return item;
}

// Across all four edges of the image, and behind the camera.
TEST(StuffLooks, ByItsBoundsAThingIsOutOfViewWhereAllItsPointsAre) {
  int out = 0;
  for (double const z_m : {1.5, 0.05, -1.5}) {
    for (double x_m = -1.2; x_m < 1.3; x_m += 0.013) {
      for (View const& view : {View{.boards = {{kFirst}}, .x_m = x_m}, View{.y_m = x_m}}) {
        StuffLook const fast = look(view, square(0, z_m));
        StuffLook const slow = look(view, without_bounds(square(0, z_m)));
        ASSERT_EQ(fast.counts, slow.counts) << x_m;
        ASSERT_EQ(fast.blocks, slow.blocks) << x_m;
        out += fast.counts[PointState::kOutOfView] == 100 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(out, 200);
  EXPECT_LT(out, 1000);
}

TEST(StuffLooks, AreTheSameAtAnyNumberOfThreads) {
  Segmentation const frame = test::segmentation_of({.boards = {{kFirst}}});
  std::vector<StuffBelief> things;
  for (int i = 0; i < 200; ++i) {
    things.push_back(square(0.001 * i, 1.5 + 0.001 * (i % 7)));
  }
  StuffLooks const many(frame.sight, frame.T_world_camera, things);
  tbb::global_control const one(tbb::global_control::max_allowed_parallelism, 1);
  StuffLooks const single(frame.sight, frame.T_world_camera, things);
  for (std::size_t block = 0; block < many.owners().size(); ++block) {
    ASSERT_EQ(many.owners()[block], single.owners()[block]);
  }
  for (std::size_t i = 0; i < things.size(); ++i) {
    ASSERT_EQ(many.looks()[i].counts, single.looks()[i].counts);
    ASSERT_EQ(many.looks()[i].blocks, single.looks()[i].blocks);
  }
  // Of two that fit a block equally well it is the first one's.
  EXPECT_EQ((many.owners()[Pixel{81, 61}]), 0);
}

TEST(StuffLooks, ABlockIsTheThingsThatFitsItBest) {
  Segmentation const frame = test::segmentation_of({.boards = {{kFirst}}});
  StuffLooks const looks(frame.sight, frame.T_world_camera,
                         {square(0, 1.51), square(0.1, 1.505), square(1.0, 1.5)});
  EXPECT_EQ((looks.owners()[Pixel{81, 61}]), 0);
  EXPECT_EQ((looks.owners()[Pixel{95, 61}]), 1);
  EXPECT_EQ((looks.owners()[Pixel{10, 61}]), -1);
  // Of each thing every block counts, whosever it is.
  EXPECT_EQ(looks.looks()[0].blocks, 400);
}

TEST(StuffLooks, InPiecesEachClusterHasItsShare) {
  Board const left{kFirst, 0.0, 0.0, 0.12, 0.2};
  Board const right{kSecond, 0.12, 0.0, 0.08, 0.2};
  StuffLook const seen = look({.boards = {left, right}}, square(0, 1.5));
  ASSERT_EQ(seen.shares.size(), 2U);
  EXPECT_EQ(seen.shares[0].blocks, 240);
  EXPECT_EQ(seen.shares[1].blocks, 160);
  EXPECT_EQ(seen.blocks, 400);
}

}  // namespace
}  // namespace credo
