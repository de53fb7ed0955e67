#include "stages/planes/plane_pixels.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>
#include <vector>

namespace credo {
namespace {

/// Points about a plane at depths of 0.5 to 4 m, every 7th without a normal, every 11th invalid,
/// every 5th not asked for.
struct Points {
  OrganizedCloud cloud;
  NormalMap normals;
  PixelSet asked;

  Points(int width, int height)
      : cloud(width, height),
        normals(width, height),
        asked(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (i % 11 != 3) {
        Eigen::Vector3f const p(unit(random), unit(random), 2.25F + 1.75F * unit(random));
        cloud.set(i, p);
        if (i % 5 != 2) {
          asked.insert(i);
        }
      }
      if (i % 7 != 1) {
        normals.set(i, Eigen::Vector3f(unit(random), unit(random), unit(random)).normalized());
      }
    }
  }
};

Plane some_plane() {
  Eigen::Vector3d const normal = Eigen::Vector3d(0.4, -0.7, 0.3).normalized();
  return {normal, 0.3};
}

/// The rule, said plainly, in the precision and order of the fast one.
struct Literal {
  Plane plane;
  PlaneTolerance tolerance;

  [[nodiscard]] float distance_m(Eigen::Vector3f const& p) const {
    Eigen::Vector3f const n = plane.normal.cast<float>();
    return n.x() * p.x() + n.y() * p.y() + n.z() * p.z() - static_cast<float>(plane.offset_m);
  }
  [[nodiscard]] bool belongs(Eigen::Vector3f const& p, Eigen::Vector3f const& m) const {
    Eigen::Vector3f const n = plane.normal.cast<float>();
    float const cosine = std::abs(n.x() * m.x() + n.y() * m.y() + n.z() * m.z());
    bool const turned = tolerance.min_cosine > 0.0F && cosine < tolerance.min_cosine;
    return is_near(p) && !turned;
  }
  [[nodiscard]] bool is_near(Eigen::Vector3f const& p) const {
    return std::abs(distance_m(p)) <= tolerance.distance_m(p.z());
  }
};

void expect_equals_literal(Points const& points, PlaneTolerance const& tolerance) {
  Literal const literal{some_plane(), tolerance};
  auto const [inliers, turned] =
      plane_pixels(literal.plane, points.cloud, points.normals, points.asked, tolerance);
  CountedPixels const behind = pixels_behind(literal.plane, points.cloud, points.asked, tolerance);
  std::size_t count = 0;
  std::size_t count_turned = 0;
  std::size_t count_behind = 0;
  for (std::size_t i = 0; i < points.cloud.size(); ++i) {
    bool const asked = points.asked.contains(i);
    bool const belongs = asked && literal.belongs(points.cloud.at(i), points.normals.at(i));
    ASSERT_EQ(inliers.pixels.contains(i), belongs) << "pixel " << i;
    count += belongs ? 1 : 0;
    bool const is_turned = asked && literal.is_near(points.cloud.at(i)) && !belongs;
    ASSERT_EQ(turned.contains(i), is_turned) << "pixel " << i;
    count_turned += is_turned ? 1 : 0;
    bool const is_behind =
        asked && literal.distance_m(points.cloud.at(i)) < -tolerance.distance_m(points.cloud.z[i]);
    ASSERT_EQ(behind.pixels.contains(i), is_behind) << "pixel " << i;
    count_behind += is_behind ? 1 : 0;
  }
  EXPECT_EQ(inliers.count, count);
  EXPECT_EQ(count_turned > 0, tolerance.min_cosine > 0.0F && points.cloud.size() > 5);
  EXPECT_EQ(behind.count, count_behind);
}

std::vector<PlaneTolerance> tolerances() {
  return {{0.05F, 0.0F, 0.0F}, {0.015F, 4.0F, 0.9F}, {0.3F, 1.0F, 0.3F}};
}

TEST(PlanePixels, EqualTheLiteralRuleOnEveryInstructionSet) {
  Points const points(67, 41);  // no multiple of any vector, nor of a word
  int compared = 0;
  for (std::int64_t target = hwy::SupportedTargets(); target != 0; target &= target - 1) {
    hwy::SetSupportedTargetsForTest(static_cast<std::int64_t>(target & -target));
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (PlaneTolerance const& tolerance : tolerances()) {
      expect_equals_literal(points, tolerance);
    }
    ++compared;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GT(compared, 0);
}

TEST(PlanePixels, OfImagesOfAnySizeEqualTheLiteralRule) {
  for (int const width : {1, 63, 64, 65, 128}) {
    expect_equals_literal(Points(width, 1), tolerances()[1]);
  }
}

TEST(PlanePixels, OfAnEmptyImageAreNone) {
  OrganizedCloud const cloud;
  CountedPixels const inliers =
      plane_inliers(some_plane(), cloud, NormalMap(), PixelSet(0), {0.05F, 0.0F, 0.0F});
  EXPECT_EQ(inliers.count, 0U);
  EXPECT_EQ(pixels_behind(some_plane(), cloud, PixelSet(0), {0.05F, 0.0F, 0.0F}).count, 0U);
}

TEST(PlaneTolerance, FollowsTheNoiseWhereThatIsMore) {
  PlaneTolerance const tolerance{0.015F, 4.0F, 0.0F};
  EXPECT_FLOAT_EQ(tolerance.distance_m(0.4F), 0.015F);
  // 4 (0.0012 + 0.0019 2.6^2)
  EXPECT_NEAR(tolerance.distance_m(3.0F), 0.056176F, 1e-6F);
}

}  // namespace
}  // namespace credo
