#include "stages/fusion/stuff/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace credo {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// A square of so many points along each edge.
Points square(int edge, float spacing_m) {
  Points points;
  for (int i = 0; i < edge * edge; ++i) {
    points.emplace_back(spacing_m * (static_cast<float>(i % edge) + 0.5F),
                        spacing_m * (static_cast<float>(i / edge) + 0.5F), 0.004F);
  }
  return points;
}

TEST(StuffModel, SpacingIsAPartOfTheSize) {
  EXPECT_FLOAT_EQ(new_model({}, 0.0001).spacing_m, 0.008F);
  EXPECT_FLOAT_EQ(new_model({}, 0.25).spacing_m, 0.02F);
  EXPECT_FLOAT_EQ(new_model({}, 4.0).spacing_m, 0.04F);
  EXPECT_TRUE(new_model({}, 1.0).points.empty());
}

TEST(StuffModel, HasOnePointToACell) {
  StuffModel const model = new_model(square(20, 0.004F), 0.0001);
  ASSERT_EQ(model.points.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(model.cells));
  for (SurfacePoint const& point : model.points) {
    // The middle of four.
    Eigen::Vector3f const in_cell = point.p_world / 0.008F;
    EXPECT_NEAR(in_cell.x() - std::floor(in_cell.x()), 0.5F, 1e-3F);
    EXPECT_EQ(point.weight, 1.0F);
  }
}

TEST(StuffModel, APointIsTheMeanOfItsLastLooks) {
  StuffModel model = new_model(Points{{0.001F, 0.001F, 0.001F}}, 0.0001);
  for (int i = 0; i < 3; ++i) {
    model = fused_model(model, Points{{0.005F, 0.001F, 0.001F}});
  }
  ASSERT_EQ(model.points.size(), 1U);
  EXPECT_NEAR(model.points[0].p_world.x(), 0.004F, 1e-6F);
  EXPECT_EQ(model.points[0].weight, 4.0F);
  for (int i = 0; i < 20; ++i) {
    model = fused_model(model, Points{{0.005F, 0.001F, 0.001F}});
  }
  EXPECT_EQ(model.points[0].weight, 12.0F);
  float const before_m = model.points[0].p_world.x();
  model = fused_model(model, Points{{0.001F, 0.001F, 0.001F}});
  EXPECT_NEAR(model.points[0].p_world.x(), before_m + (0.001F - before_m) / 12.0F, 1e-7F);
}

TEST(StuffModel, GrowsByWhatWasNotThere) {
  StuffModel const one = new_model(Points{{0.001F, 0.0F, 0.0F}}, 0.0001);
  StuffModel const both = fused_model(one, Points{{0.1F, 0.0F, 0.0F}, {-0.1F, 0.0F, 0.0F}});
  ASSERT_EQ(both.points.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(both.cells));
  EXPECT_EQ(both.points[0].p_world.x(), -0.1F);
  EXPECT_EQ(both.points[1].p_world.x(), 0.001F);
  EXPECT_EQ(both.points[2].p_world.x(), 0.1F);
}

TEST(StuffModel, HoldsNoMoreThan4000Points) {
  StuffModel const model = new_model(square(100, 0.008F), 0.0001);
  EXPECT_LE(model.points.size(), 4000U);
  EXPECT_GT(model.points.size(), 1000U);
  EXPECT_FLOAT_EQ(model.spacing_m, 0.008F * 1.5F * 1.5F);
}

TEST(StuffModel, LosesWhatIsSeenThroughTooOften) {
  StuffModel model = new_model(square(10, 0.008F), 0.0001);
  for (std::size_t i = 0; i < 30; ++i) {
    model.points[i].missed = 2.0F;
  }
  model.points[40].missed = 1.99F;
  StuffModel const carved = carved_model(model);
  ASSERT_EQ(carved.points.size(), 70U);
  EXPECT_EQ(carved.cells.size(), 70U);
  EXPECT_EQ(carved.points[0].p_world, model.points[30].p_world);
  EXPECT_EQ(carved.cells[69], model.cells[99]);
  for (SurfacePoint& point : model.points) {
    point.missed = 3.0F;
  }
  EXPECT_EQ(carved_model(model).points.size(), 100U);
}

TEST(StuffModel, IsAClusterToWhoeverReadsIt) {
  StuffModel const model = new_model(square(4, 0.008F), 0.0001);
  StuffCluster const cluster = cluster_of(model, kFirstStuff + 3, 77);
  EXPECT_EQ(cluster.label, kFirstStuff + 3);
  EXPECT_EQ(cluster.pixel_count, 77U);
  EXPECT_EQ(cluster.points_world.size(), 16U);
  EXPECT_TRUE(cluster.centroid_world.isApprox(Eigen::Vector3f(0.016F, 0.016F, 0.004F), 1e-5F));
  EXPECT_TRUE(cluster.bounds_world.max().isApprox(Eigen::Vector3f(0.028F, 0.028F, 0.004F), 1e-5F));
}

}  // namespace
}  // namespace credo
