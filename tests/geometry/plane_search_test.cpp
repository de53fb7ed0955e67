#include "geometry/plane_search.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "geometry/plane_search_kernels.hpp"

namespace credo {
namespace {

constexpr float kNoNormal = std::numeric_limits<float>::quiet_NaN();

Plane tilted_plane() {
  Eigen::Vector3d const normal = Eigen::Vector3d(0.2, -0.3, 0.9).normalized();
  return {normal, 0.7};
}

/// `count` points on the plane within 1 m, scattered by `noise_m` along its normal.
void add_plane(PlaneSearchPoints& points, Plane const& plane, int count, double noise_m,
               unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, noise_m);
  Eigen::Vector3d const across = plane.normal.unitOrthogonal();
  Eigen::Vector3d const along = plane.normal.cross(across);
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d const p = (plane.offset_m + noise(random)) * plane.normal +
                              place(random) * across + place(random) * along;
    points.add(p.cast<float>(), plane.normal.cast<float>(), 0.02F,
               static_cast<std::uint32_t>(points.size()));
  }
}

/// Points anywhere, with normals that point anywhere.
void add_clutter(PlaneSearchPoints& points, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  auto const draw = [&] { return Eigen::Vector3f(place(random), place(random), place(random)); };
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3f const p = draw();
    points.add(p, draw().normalized(), 0.02F, static_cast<std::uint32_t>(points.size()));
  }
}

class PlaneSearch : public ::testing::TestWithParam<PlaneSearchLimits> {};

TEST_P(PlaneSearch, FindsTheLargestAmongTwoAndClutter) {
  Plane const larger = tilted_plane();
  Plane const smaller{Eigen::Vector3d::UnitX(), -0.4};
  PlaneSearchPoints points;
  add_clutter(points, 500, 1);
  add_plane(points, smaller, 800, 0.003, 2);
  add_plane(points, larger, 1500, 0.003, 3);
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    PlaneSearchLimits limits = GetParam();
    limits.seed = seed;
    auto const found = find_largest_plane(points, limits);
    ASSERT_TRUE(found);
    double const sign = found->plane.normal.dot(larger.normal) < 0 ? -1.0 : 1.0;
    EXPECT_LT(std::acos(std::min(1.0, sign * found->plane.normal.dot(larger.normal))), 0.005);
    EXPECT_NEAR(sign * found->plane.offset_m, larger.offset_m, 0.002);
    // All of its own points (7 standard deviations), and the clutter that happens to lie in it.
    EXPECT_GE(found->inlier_count, 1495U);
    EXPECT_LE(found->inlier_count, 1600U);
    EXPECT_EQ(std::accumulate(found->inliers.begin(), found->inliers.end(), std::size_t{0}),
              found->inlier_count);
  }
}

TEST(PlaneSearchDraws, GoOnAfterADrawThatNoPointAgreesWith) {
  // Half of the points have normals that lie across all planes there are, and tolerances that not
  // even they meet: a draw from one of them has no inlier at all.
  PlaneSearchPoints points;
  add_plane(points, tilted_plane(), 500, 0.003, 3);
  for (int i = 0; i < 500; ++i) {
    points.add({static_cast<float>(i), 50.0F, 7.0F}, {0.0F, 0.0F, 1.0F}, -1.0F, 1000);
  }
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    PlaneSearchLimits limits;
    limits.sampling = PlaneSampling::kPointAndNormal;
    limits.seed = seed;
    auto const found = find_largest_plane(points, limits);
    ASSERT_TRUE(found);
    EXPECT_GT(found->inlier_count, 490U) << "seed " << seed;
  }
}

TEST_P(PlaneSearch, IsRepeatableForASeed) {
  PlaneSearchPoints points;
  add_clutter(points, 500, 1);
  add_plane(points, tilted_plane(), 600, 0.01, 3);
  auto const one = find_largest_plane(points, GetParam());
  auto const other = find_largest_plane(points, GetParam());
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->plane.normal, other->plane.normal);
  EXPECT_EQ(one->inliers, other->inliers);
}

TEST_P(PlaneSearch, FindsNothingInTooLittle) {
  PlaneSearchPoints points;
  EXPECT_FALSE(find_largest_plane(points, GetParam()));
  points.add({0, 0, 0}, {kNoNormal, kNoNormal, kNoNormal}, 0.02F, 0);
  points.add({1, 0, 0}, {kNoNormal, kNoNormal, kNoNormal}, 0.02F, 1);
  EXPECT_FALSE(find_largest_plane(points, GetParam()));
  // In one line, and without normals: no plane is better than another.
  points.add({2, 0, 0}, {kNoNormal, kNoNormal, kNoNormal}, 0.02F, 2);
  EXPECT_FALSE(find_largest_plane(points, GetParam()));
}

PlaneSearchLimits with_normals() {
  PlaneSearchLimits limits;
  limits.sampling = PlaneSampling::kPointAndNormal;
  limits.max_angle_rad = 0.35;
  return limits;
}

INSTANTIATE_TEST_SUITE_P(Ways, PlaneSearch, ::testing::Values(PlaneSearchLimits{}, with_normals()),
                         [](auto const& way) { return way.index == 0 ? "Points" : "Normals"; });

TEST(InliersOf, JudgesPointsWithoutNormalByDistanceAlone) {
  PlaneSearchPoints points;
  points.add({0, 0, 0.01F}, {0, 0, 1}, 0.02F, 0);
  points.add({0, 0, 0.01F}, {0, 0, -1}, 0.02F, 1);  // the same plane seen from beneath
  points.add({0, 0, 0.01F}, {1, 0, 0}, 0.02F, 2);
  points.add({0, 0, 0.01F}, {kNoNormal, kNoNormal, kNoNormal}, 0.02F, 3);
  points.add({0, 0, 0.03F}, {0, 0, 1}, 0.02F, 4);
  points.add({0, 0, 0.03F}, {0, 0, 1}, 0.04F, 5);
  Plane const floor;
  EXPECT_EQ(inliers_of(floor, points, 0.3).inliers, (std::vector<std::uint8_t>{1, 1, 0, 1, 0, 1}));
  EXPECT_EQ(inliers_of(floor, points, 3.15).inliers, (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 1}));
}

void expect_that_each_tells_by_itself() {
  for (int count = 0; count < 40; ++count) {
    PlaneSearchPoints points;
    add_plane(points, tilted_plane(), count, 0.01, 1);
    add_clutter(points, count % 7, 2);
    for (int i = 0; i < count; i += 3) {
      points.normal_x[static_cast<std::size_t>(i)] = kNoNormal;
    }
    for (double const max_angle_rad : {0.0, 0.3, 3.15}) {
      FoundPlane const found = inliers_of(tilted_plane(), points, max_angle_rad);
      plane_search::FloatPlane const plane(tilted_plane(), max_angle_rad);
      std::size_t belonging = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(found.inliers[i], plane_search::belongs(plane, points, i)) << count << ' ' << i;
        belonging += found.inliers[i];
      }
      EXPECT_EQ(found.inlier_count, belonging);
      EXPECT_EQ(plane_search::count_belonging(plane, points, 0), belonging);
    }
  }
}

TEST(InliersOf, AreThoseThatEachTellsByItselfOnEveryInstructionSet) {
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    expect_that_each_tells_by_itself();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(PlaneSearchKernels, CountInFullWhatBeatsTheBest) {
  PlaneSearchPoints points;
  add_plane(points, tilted_plane(), 700, 0.01, 1);
  add_clutter(points, 900, 2);
  plane_search::FloatPlane const plane(tilted_plane(), 0.3);
  std::size_t const all = plane_search::count_belonging(plane, points, 0);
  EXPECT_GT(all, 500U);
  for (std::size_t to_beat = 0; to_beat < points.size(); to_beat += 50) {
    std::size_t const count = plane_search::count_belonging(plane, points, to_beat);
    if (all > to_beat) {
      EXPECT_EQ(count, all);
    } else {
      EXPECT_LE(count, to_beat);
    }
  }
}

TEST(FitPlane, WeighsPointsByTheirTolerance) {
  PlaneSearchPoints points;
  for (int i = 0; i < 4; ++i) {
    auto const x = static_cast<float>(i % 2);
    auto const y = static_cast<float>(i / 2);
    points.add({x, y, 0.0F}, {0, 0, 1}, 0.01F, 0);
    points.add({x, y, 0.3F}, {0, 0, 1}, 0.1F, 0);
  }
  std::vector<std::uint8_t> const all(points.size(), 1);
  auto const plane = fit_plane(points, all, Eigen::Vector3d::UnitZ());
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->normal.z(), 1.0, 1e-9);
  // 1 : 100 in weight.
  EXPECT_NEAR(plane->offset_m, 0.3 / 101.0, 1e-6);
  EXPECT_NEAR(fit_plane(points, all, -Eigen::Vector3d::UnitZ())->offset_m, -0.3 / 101.0, 1e-6);
}

TEST(PlaneSearchPoints, KeepsWhatIsNotRemovedInAllColumns) {
  std::mt19937 random(5);
  for (std::uint32_t count = 0; count < 70; ++count) {
    PlaneSearchPoints points;
    std::vector<std::uint8_t> removed;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < count; ++i) {
      auto const value = static_cast<float>(i);
      points.add({value, value + 100, value + 200}, {value + 300, value + 400, value + 500},
                 value + 600, i);
      removed.push_back(random() % 3 == 0 ? 0 : 1);
      if (removed.back() == 0) {
        kept.push_back(i);
      }
    }
    points.remove(removed);
    EXPECT_EQ(points.source, kept);
    ASSERT_EQ(points.size(), kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
      auto const value = static_cast<float>(kept[k]);
      EXPECT_EQ(points.x[k], value);
      EXPECT_EQ(points.y[k], value + 100);
      EXPECT_EQ(points.z[k], value + 200);
      EXPECT_EQ(points.normal_x[k], value + 300);
      EXPECT_EQ(points.normal_y[k], value + 400);
      EXPECT_EQ(points.normal_z[k], value + 500);
      EXPECT_EQ(points.tolerance_m[k], value + 600);
    }
  }
}

TEST(PlaneSearchPoints, KeepsTheOrderOfWhatRemains) {
  PlaneSearchPoints points;
  for (std::uint32_t i = 0; i < 5; ++i) {
    points.add({static_cast<float>(i), 0, 0}, {0, 0, 1}, 0.01F, 10 + i);
  }
  points.remove(std::vector<std::uint8_t>{1, 0, 0, 1, 0});
  EXPECT_EQ(points.source, (std::vector<std::uint32_t>{11, 12, 14}));
  EXPECT_EQ(points.x, (std::vector<float>{1, 2, 4}));
  EXPECT_EQ(points.tolerance_m.size(), 3U);
}

}  // namespace
}  // namespace credo
