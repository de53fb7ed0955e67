#include "baselines/verification.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::test {
namespace {

/// The front of a box a metre ahead, points 2 mm apart, `shift_m` to the side of the middle.
VerifiedCloud::Ptr front(float shift_m) {
  auto cloud = std::make_shared<VerifiedCloud>();
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) {
      pcl::PointXYZI point;
      point.getVector3fMap() = Eigen::Vector3f(shift_m + 0.002F * static_cast<float>(i - 30),
                                               0.002F * static_cast<float>(j - 30), 1.0F);
      cloud->push_back(point);
    }
  }
  return cloud;
}

/// What the camera sees: a wall at 2 m with the box before it.
VerifiedCloud::Ptr frame() {
  auto cloud = std::make_shared<VerifiedCloud>(640, 480);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      Eigen::Vector3f const ray((static_cast<float>(u) - 319.5F) / 525.0F,
                                (static_cast<float>(v) - 239.5F) / 525.0F, 1.0F);
      bool const box = std::abs(ray.x()) < 0.06F && std::abs(ray.y()) < 0.06F;
      (*cloud)(u, v).getVector3fMap() = (box ? 1.0F : 2.0F) * ray;
    }
  }
  return cloud;
}

// PCL's verification decides differently from process to process about what could stand; what must
// fall falls always.

TEST(Verification, WhatTheCameraLooksThroughFalls) {
  std::vector<bool> const stands = verified(front(0.0F), frame(), {front(0.0F), front(0.3F)}, {});
  ASSERT_EQ(stands.size(), 2U);
  EXPECT_FALSE(stands[1]);
}

TEST(Verification, OfTwoThatExplainTheSameOneStandsAtMost) {
  std::vector<bool> const stands = verified(front(0.0F), frame(), {front(0.05F), front(0.0F)}, {});
  ASSERT_EQ(stands.size(), 2U);
  EXPECT_FALSE(stands[0] && stands[1]);
}

TEST(Verification, OfNothingNothingStands) {
  EXPECT_TRUE(verified(front(0.0F), frame(), {}, {}).empty());
}

}  // namespace
}  // namespace credo::test
