#include "stages/clustering/label_spreading.hpp"

#include <gmock/gmock.h>

namespace credo {
namespace {

using ::testing::ElementsAre;

constexpr float kRadius = 0.05F;
constexpr LabelCode kStuff = kFirstStuff;
constexpr LabelCode kWall = kFirstWall;

// One row of pixels at the given places along x; no pixel has a normal unless it is given one.
struct Row {
  Row(std::vector<float> const& x_m, std::vector<LabelCode> codes)
      : cloud(static_cast<int>(x_m.size()), 1),
        normals(cloud.width(), 1),
        labels(cloud.width(), 1, std::move(codes)) {
    for (std::size_t i = 0; i < x_m.size(); ++i) {
      if (labels[i] != kNoDepth) {
        cloud.set(i, {x_m[i], 0.0F, 1.0F});
      }
    }
  }
  [[nodiscard]] LabelMap spread(int max_steps) const {
    return spread_labels(cloud, normals, labels, kRadius, max_steps);
  }

  OrganizedCloud cloud;
  NormalMap normals;
  LabelMap labels;
};

TEST(SpreadLabels, GoesOnePixelAStep) {
  Row const row({0.00F, 0.01F, 0.02F, 0.03F}, {kStuff, kUnassigned, kUnassigned, kUnassigned});
  EXPECT_THAT(row.spread(0), ElementsAre(kStuff, kUnassigned, kUnassigned, kUnassigned));
  EXPECT_THAT(row.spread(1), ElementsAre(kStuff, kStuff, kUnassigned, kUnassigned));
  EXPECT_THAT(row.spread(2), ElementsAre(kStuff, kStuff, kStuff, kUnassigned));
  EXPECT_THAT(row.spread(9), ElementsAre(kStuff, kStuff, kStuff, kStuff));
}

TEST(SpreadLabels, TakesTheNearestInSpace) {
  Row const row({0.00F, 0.03F, 0.04F}, {kFloor, kUnassigned, kWall});
  EXPECT_THAT(row.spread(1), ElementsAre(kFloor, kWall, kWall));
  Row const tie({-0.03125F, 0.0F, 0.03125F}, {kFloor, kUnassigned, kWall});
  EXPECT_THAT(tie.spread(1), ElementsAre(kFloor, kFloor, kWall));
}

TEST(SpreadLabels, StopsAtADepthJump) {
  Row const row({0.00F, 0.06F, 0.11F}, {kStuff, kUnassigned, kWall});
  EXPECT_EQ(row.spread(5)[std::size_t{1}], kWall);
  Row const alone({0.00F, 0.06F, 0.12F}, {kStuff, kUnassigned, kWall});
  EXPECT_EQ(alone.spread(5)[std::size_t{1}], kUnassigned);
}

TEST(SpreadLabels, TakesARadiusOfExactlyTheLimit) {
  OrganizedCloud cloud(2, 1);
  cloud.set(0, {0.0F, 0.0F, 1.0F});
  cloud.set(1, {0.0625F, 0.0F, 1.0F});
  LabelMap const labels(2, 1, {kStuff, kUnassigned});
  EXPECT_THAT(spread_labels(cloud, NormalMap(2, 1), labels, 0.0625F, 1),
              ElementsAre(kStuff, kStuff));
}

TEST(SpreadLabels, LeavesPixelsWithANormalAndWithoutDepth) {
  Row row({0.00F, 0.01F, 0.02F, 0.03F}, {kStuff, kUnassigned, kStuff, kNoDepth});
  row.normals.set(1, -Eigen::Vector3f::UnitZ());
  EXPECT_THAT(row.spread(5), ElementsAre(kStuff, kUnassigned, kStuff, kNoDepth));
}

TEST(SpreadLabels, ReachesAllEightNeighbours) {
  for (int k = 0; k < 9; ++k) {
    OrganizedCloud cloud(3, 3);
    LabelMap labels(3, 3, kUnassigned);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      cloud.set(i, {0.01F * static_cast<float>(i % 3), 0.01F * static_cast<float>(i / 3), 1.0F});
    }
    labels[static_cast<std::size_t>(k)] = kFirstObject;
    LabelMap const spread = spread_labels(cloud, NormalMap(3, 3), labels, kRadius, 1);
    EXPECT_EQ(spread[std::size_t{4}], kFirstObject) << "from neighbour " << k;
  }
}

TEST(SpreadLabels, DegenerateSizes) {
  EXPECT_TRUE(spread_labels({}, {}, {}, kRadius, 5).empty());
  LabelMap const one(1, 1, kUnassigned);
  EXPECT_EQ(spread_labels(OrganizedCloud(1, 1), NormalMap(1, 1), one, kRadius, 5), one);
}

}  // namespace
}  // namespace credo
