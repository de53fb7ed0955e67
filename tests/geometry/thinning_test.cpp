#include "geometry/thinning.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>

#include "core/cloud.hpp"

namespace credo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

PointList random_points(std::size_t count, float half_width_m) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-half_width_m, half_width_m);
  PointList points(count);
  for (Eigen::Vector3f& p : points) {
    p = {coordinate(random), coordinate(random), coordinate(random)};
  }
  return points;
}

using Cell = std::tuple<int, int, int>;
Cell cell_of(Eigen::Vector3f const& p, double spacing_m) {
  auto const along = [&](float value) {
    return static_cast<int>(std::floor(static_cast<double>(value) / spacing_m));
  };
  return {along(p.x()), along(p.y()), along(p.z())};
}

TEST(ThinPoints, GivesTheMeanOfEachCellInOrderOfItsFirstPoint) {
  PointList const points = {{1.1F, 0.2F, 0.2F}, {0.1F, 0.2F, 0.2F}, {1.3F, 0.4F, 0.6F}};
  PointList const thinned = thin_points(points, 1.0F);
  ASSERT_THAT(thinned, SizeIs(2));
  EXPECT_TRUE(thinned[0].isApprox(Eigen::Vector3f(1.2F, 0.3F, 0.4F), 1e-6F));
  EXPECT_EQ(thinned[1], points[1]);
}

TEST(ThinPoints, KeepsPointsOnBothSidesOfTheOriginApart) {
  EXPECT_THAT(thin_points(PointList{{-0.1F, 0, 0}, {0.1F, 0, 0}}, 1.0F), SizeIs(2));
}

TEST(ThinPoints, AgreesWithAMapOfCells) {
  double const spacing_m = 0.125;
  PointList const points = random_points(20000, 1.5F);
  std::map<Cell, std::pair<Eigen::Vector3d, int>> cells;
  for (Eigen::Vector3f const& p : points) {
    auto& [sum, count] =
        cells.try_emplace(cell_of(p, spacing_m), Eigen::Vector3d(0, 0, 0), 0).first->second;
    sum += p.cast<double>();
    ++count;
  }
  PointList const thinned = thin_points(points, static_cast<float>(spacing_m));
  ASSERT_EQ(thinned.size(), cells.size());
  for (Eigen::Vector3f const& p : thinned) {
    auto const& [sum, count] = cells.at(cell_of(p, spacing_m));
    EXPECT_EQ(p, Eigen::Vector3f((sum / count).cast<float>()));
  }
}

TEST(ThinPoints, ComesBackTheSameWhenThinnedAgain) {
  PointList const thinned = thin_points(random_points(5000, 2.0F), 0.1F);
  EXPECT_EQ(thin_points(thinned, 0.1F), thinned);
}

TEST(ThinPoints, SkipsWhatIsNotFinite) {
  float const infinity = std::numeric_limits<float>::infinity();
  PointList const points = {{kNaN, 0, 0}, {1, 2, 3}, {0, infinity, 0}, {0, 0, -infinity}};
  EXPECT_THAT(thin_points(points, 0.1F), ElementsAre(Eigen::Vector3f(1, 2, 3)));
  EXPECT_THAT(thin_points(PointList{{kNaN, kNaN, kNaN}}, 0.1F), IsEmpty());
  EXPECT_THAT(thin_points({}, 0.1F), IsEmpty());
}

TEST(ThinPoints, TakesAnyFinitePoint) {
  PointList const far = {{1e30F, 0, 0}, {-1e30F, 0, 0}};
  EXPECT_EQ(thin_points(far, 0.01F), far);
}

TEST(ThinPoints, RefusesASpacingThatIsNone) {
  PointList const points = {{0, 0, 0}};
  EXPECT_THROW((void)thin_points(points, 0.0F), std::logic_error);
  EXPECT_THROW((void)thin_points(points, -1.0F), std::logic_error);
  EXPECT_THROW((void)thin_points(points, kNaN), std::logic_error);
}

TEST(MergedPoints, KeepsTheKnownFirstAndAddsTheMeanOfEachNewCell) {
  PointList const known = {{0.9F, 0, 0}, {5.1F, 0, 0}, {5.2F, 0, 0}};
  PointList const added = {{0.1F, 0, 0}, {7.2F, 0, 0}, {5.5F, 0, 0}, {7.4F, 0, 0}, {kNaN, 0, 0}};
  PointList const merged = merged_points(known, added, 1.0F);
  ASSERT_THAT(merged, SizeIs(4));
  EXPECT_EQ(PointList(merged.begin(), merged.begin() + 3), known);
  EXPECT_TRUE(merged[3].isApprox(Eigen::Vector3f(7.3F, 0, 0), 1e-6F));
}

TEST(MergedPoints, AddsNothingTwice) {
  PointList const points = thin_points(random_points(5000, 2.0F), 0.1F);
  EXPECT_EQ(merged_points(points, points, 0.1F), points);
  EXPECT_EQ(merged_points(points, {}, 0.1F), points);
  EXPECT_EQ(merged_points({}, points, 0.1F), points);
}

}  // namespace
}  // namespace credo
