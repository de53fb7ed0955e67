#include "core/grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/belief.hpp"
#include "core/frame.hpp"
#include "core/plane.hpp"
#include "core/segmentation.hpp"

namespace credo {
namespace {

TEST(Grid, IsRowMajor) {
  Grid<int> grid(3, 2, {0, 1, 2, 3, 4, 5});
  EXPECT_EQ((grid[Pixel{2, 0}]), 2);
  EXPECT_EQ((grid[Pixel{0, 1}]), 3);
  EXPECT_EQ(grid.row(1)[2], 5);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_EQ(grid.index(grid.pixel(i)), i);
  }
  EXPECT_FALSE(grid.contains({3, 0}));
  EXPECT_FALSE(grid.contains({0, -1}));
}

TEST(Grid, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(Grid<int>(-1, 2), std::logic_error);
  EXPECT_THROW(Grid<int>(2, 2, {1, 2, 3}), std::logic_error);
  EXPECT_TRUE(Grid<int>(0, 0).empty());
}

TEST(CloudFromDepth, ProjectsBackToItsPixels) {
  CameraIntrinsics const camera{500, 510, 3.25, 2.5};
  Grid<float> depth(8, 6, 1.7F);
  depth[Pixel{1, 1}] = 0.0F;
  depth[Pixel{2, 1}] = -1.0F;
  depth[Pixel{3, 1}] = kNaN;
  depth[Pixel{4, 1}] = std::numeric_limits<float>::infinity();
  OrganizedCloud const cloud = cloud_from_depth(std::move(depth), camera);
  int invalid = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.valid(i)) {
      ++invalid;
      EXPECT_TRUE(std::isnan(cloud.x[i]) && std::isnan(cloud.y[i]) && std::isnan(cloud.z[i]));
      continue;
    }
    Pixel const p = cloud.x.pixel(i);
    EXPECT_NEAR(camera.fx_px * cloud.x[i] / cloud.z[i] + camera.cx_px, p.u, 1e-4);
    EXPECT_NEAR(camera.fy_px * cloud.y[i] / cloud.z[i] + camera.cy_px, p.v, 1e-4);
  }
  EXPECT_EQ(invalid, 4);
  EXPECT_TRUE(cloud_from_depth({}, camera).empty());
}

TEST(UnassignedSegmentation, TellsDepthFromNoDepth) {
  Frame frame;
  frame.cloud_camera = cloud_from_depth(Grid<float>(2, 1, {1.0F, 0.0F}), {});
  Segmentation const s = unassigned_segmentation(frame, {}, kPriorFrame);
  EXPECT_EQ(s.labels[0], kUnassigned);
  EXPECT_EQ(s.labels[1], kNoDepth);
}

TEST(Plane, KeepsItsDistancesInAnotherFrame) {
  Plane const plane{Eigen::Vector3d(1, 2, 2) / 3.0, 0.7};
  Se3 const T_a_b(so3_exp({0.3, -0.2, 1.0}), {1, 2, 3});
  Eigen::Vector3d const p(0.4, -1, 2);
  EXPECT_NEAR(transformed(T_a_b, plane).signed_distance_m(T_a_b * p), plane.signed_distance_m(p),
              1e-12);
}

TEST(LogOdds, RoundTrip) {
  for (double const p : {0.01, 0.15, 0.5, 0.99}) {
    EXPECT_NEAR(probability_of(log_odds_of(p)), p, 1e-12);
  }
}

}  // namespace
}  // namespace credo
