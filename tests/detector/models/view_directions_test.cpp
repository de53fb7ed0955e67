#include "detector/models/view_directions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace credo::test {
namespace {

using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;

float nearest_cosine(Vector3f const& direction, std::size_t but) {
  std::vector<Vector3f> const all = view_directions();
  float most = -1.0F;
  for (std::size_t i = 0; i < all.size(); ++i) {
    most = i == but ? most : std::max(most, all[i].dot(direction));
  }
  return most;
}

TEST(ViewDirections, Are162UnitVectors) {
  std::vector<Vector3f> const all = view_directions();
  ASSERT_EQ(all.size(), 162U);
  for (Vector3f const& direction : all) {
    EXPECT_NEAR(direction.norm(), 1.0F, 1e-6F);
  }
}

TEST(ViewDirections, LieEvenly) {
  std::vector<Vector3f> const all = view_directions();
  for (std::size_t i = 0; i < all.size(); ++i) {
    float const nearest = std::acos(nearest_cosine(all[i], i));
    EXPECT_GT(nearest, 15.0F * kDegree);
    EXPECT_LT(nearest, 19.0F * kDegree);
  }
}

TEST(ViewDirections, OneIsWithin11DegreesOfAnyDirection) {
  std::mt19937 random(3);
  std::normal_distribution<float> number;
  for (int i = 0; i < 2000; ++i) {
    Vector3f const direction =
        Vector3f(number(random), number(random), number(random)).normalized();
    EXPECT_GT(nearest_cosine(direction, 162), std::cos(11.0F * kDegree)) << direction.transpose();
  }
}

TEST(ViewDirections, OfEachThereIsItsOpposite) {
  for (Vector3f const& direction : view_directions()) {
    EXPECT_GT(nearest_cosine(-direction, 162), 1.0F - 1e-6F);
  }
}

}  // namespace
}  // namespace credo::test
