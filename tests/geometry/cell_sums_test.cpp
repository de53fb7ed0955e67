#include "geometry/cell_sums.hpp"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <array>
#include <random>

#include "core/cloud.hpp"
#include "geometry/thinning.hpp"

namespace credo {
namespace {

constexpr float kSpacing = 0.02F;

struct Points {
  explicit Points(std::size_t count) : x(count), y(count), z(count) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> step(-0.004F, 0.005F);
    Eigen::Vector3f point(-0.3F, 0.1F, 1.0F);
    for (std::size_t i = 0; i < count; ++i) {
      point += Eigen::Vector3f(step(engine), step(engine), step(engine));
      x[i] = point.x();
      y[i] = point.y();
      z[i] = i % 17 == 3 ? kNaN : point.z();
    }
  }
  [[nodiscard]] PointSpans from(std::size_t begin, std::size_t count) const {
    return {.x = std::span(x).subspan(begin, count),
            .y = std::span(y).subspan(begin, count),
            .z = std::span(z).subspan(begin, count)};
  }

  std::vector<float> x, y, z;
};

PointList means_of(CellSums const& cells) {
  PointList means;
  cells.append_means(0, means);
  return means;
}

TEST(CellSums, DoNotDependOnThePieces) {
  Points const points(1000);
  CellSums whole(kSpacing);
  whole.add(points.from(0, 1000));
  for (std::size_t const piece : {1U, 3U, 64U, 65U, 700U}) {
    CellSums pieces(kSpacing);
    for (std::size_t begin = 0; begin < 1000; begin += piece) {
      pieces.add(points.from(begin, std::min<std::size_t>(piece, 1000 - begin)));
    }
    EXPECT_EQ(means_of(pieces), means_of(whole));
    EXPECT_EQ(pieces.mean(), whole.mean());
    EXPECT_TRUE(pieces.bounds().isApprox(whole.bounds(), 0.0F));
  }
}

TEST(CellSums, MovePointsOnTheWay) {
  Points const points(500);
  Eigen::Vector3d const axis = Eigen::Vector3d(1.0, 2.0, -1.0).normalized();
  Se3 const T_grid_points(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, axis)), {0.5, -2.0, 1.0});
  CellSums cells(kSpacing, T_grid_points);
  cells.add(points.from(0, 500));

  PointList moved;
  Eigen::AlignedBox3f bounds;
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t i = 0; i < 500; ++i) {
    Eigen::Vector3d const p =
        T_grid_points * Eigen::Vector3f(points.x[i], points.y[i], points.z[i]).cast<double>();
    if (p.allFinite()) {
      moved.emplace_back(p.cast<float>());
      bounds.extend(moved.back());
      sum += p;
    }
  }
  // Points near a cell's side may fall on the other one: moved in floats here, in doubles there.
  EXPECT_NEAR(static_cast<double>(cells.cell_count()),
              static_cast<double>(thin_points(moved, kSpacing).size()), 3.0);
  EXPECT_TRUE(cells.bounds().isApprox(bounds, 1e-5F));
  EXPECT_TRUE(
      cells.mean().isApprox((sum / static_cast<double>(moved.size())).cast<float>(), 1e-5F));
}

TEST(CellSums, OfNothingAreEmpty) {
  std::array<float, 3> const nans{kNaN, kNaN, kNaN};
  CellSums cells(kSpacing);
  cells.add({.x = nans, .y = nans, .z = nans});
  cells.add(PointSpans{});
  EXPECT_EQ(cells.cell_count(), 0U);
  EXPECT_TRUE(cells.bounds().isEmpty());
  EXPECT_TRUE(cells.mean().hasNaN());
}

// Every instruction set that this machine can run, from the plainest to the widest.
TEST(CellSums, AreTheSameOnEveryInstructionSet) {
  Points const points(777);
  Se3 const T_grid_points(Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2), {0.1, 0.2, 0.3});
  std::vector<PointList> results;
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    CellSums cells(kSpacing, T_grid_points);
    cells.add(points.from(0, 777));
    results.push_back(means_of(cells));
    results.back().push_back(cells.bounds().min());
    results.back().push_back(cells.bounds().max());
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_THAT(results, testing::Each(results.front()));
}

}  // namespace
}  // namespace credo
