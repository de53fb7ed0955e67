#include "geometry/sampled_cells.hpp"

#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "geometry/thinning.hpp"

namespace credo {
namespace {

using ::testing::IsEmpty;

constexpr float kFocal_px = 500.0F;
constexpr PixelSampling kSampling{0.02F, kFocal_px};

/// A rough slope, from near on the left to far on the right.
OrganizedCloud slope(int width, int height, float nearest_m, float farthest_m) {
  std::mt19937 random(3);
  OrganizedCloud cloud(width, height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Pixel const p = cloud.z.pixel(i);
    float const z_m =
        nearest_m + (farthest_m - nearest_m) * static_cast<float>(p.u) / static_cast<float>(width) +
        0.001F * static_cast<float>(random() % 10);
    cloud.set(i, {z_m * static_cast<float>(p.u) / kFocal_px,
                  z_m * static_cast<float>(p.v) / kFocal_px, z_m});
  }
  return cloud;
}

/// Runs of all lengths, with gaps between them.
std::vector<PixelRun> torn_runs(OrganizedCloud const& cloud) {
  std::mt19937 random(4);
  std::vector<PixelRun> runs;
  auto const width = static_cast<std::size_t>(cloud.width());
  for (std::size_t row = 0; row < cloud.size(); row += width) {
    std::size_t end = 0;
    for (std::size_t begin = random() % 5; begin < width; begin = end + random() % 4) {
      end = std::min(width, begin + 1 + random() % 200);
      runs.push_back({row + begin, row + end});
    }
  }
  return runs;
}

/// Word for word, without the rule for few cells.
PointList literal_points(OrganizedCloud const& cloud, std::vector<PixelRun> const& runs,
                         bool every_pixel) {
  PointList points;
  for (PixelRun const& run : runs) {
    auto const step = every_pixel ? 1 : static_cast<int>(kSampling.step_px(cloud.z[run.begin]));
    for (std::size_t i = run.begin; i < run.end; ++i) {
      Pixel const p = cloud.z.pixel(i);
      if (p.u % step == 0 && p.v % step == 0) {
        points.push_back(cloud.at(i));
      }
    }
  }
  return points;
}

PointList means_of(CellSums const& cells) {
  PointList means;
  cells.append_means(0, means);
  return means;
}

TEST(SampledCells, AreThoseOfEverySoManiethPixel) {
  for (int const width : {130, 333, 640}) {
    OrganizedCloud const cloud = slope(width, 97, 0.7F, 4.0F);
    std::vector<PixelRun> const runs = torn_runs(cloud);
    PointList const points = literal_points(cloud, runs, false);
    EXPECT_LT(2 * points.size(), literal_points(cloud, runs, true).size());
    CellSums const cells = sampled_cells(cloud, runs, kSampling, Se3());
    ASSERT_GE(cells.cell_count(), kFewCells);
    EXPECT_EQ(means_of(cells), thin_points(points, kSampling.spacing_m));
  }
}

TEST(SampledCells, OfFewOrWithoutAFocalLengthAreThoseOfAllPixels) {
  OrganizedCloud const small = slope(60, 50, 0.7F, 0.8F);
  std::vector<PixelRun> const runs = torn_runs(small);
  PointList const all = thin_points(literal_points(small, runs, true), kSampling.spacing_m);
  ASSERT_LT(all.size(), kFewCells);
  EXPECT_EQ(means_of(sampled_cells(small, runs, kSampling, Se3())), all);
  OrganizedCloud const large = slope(640, 97, 0.7F, 4.0F);
  EXPECT_EQ(means_of(sampled_cells(large, torn_runs(large), {kSampling.spacing_m, 0.0F}, Se3())),
            thin_points(literal_points(large, torn_runs(large), true), kSampling.spacing_m));
}

// A cable along an odd row, which no sample of every second row shows.
TEST(SampledCells, KeepWhatIsOnePixelWide) {
  OrganizedCloud const cloud = slope(640, 9, 1.0F, 1.0F);
  std::vector<PixelRun> const cable = {{640 * 3, 640 * 4}};
  EXPECT_GT(sampled_cells(cloud, cable, kSampling, Se3()).cell_count(), 50U);
}

TEST(SampledCells, HaveOneAndAHalfPixelsASideOrMoreOfWhatFacesTheCamera) {
  EXPECT_EQ(kSampling.step_px(1.66F), 4U);
  EXPECT_EQ(kSampling.step_px(1.67F), 2U);
  EXPECT_EQ(kSampling.step_px(3.33F), 2U);
  EXPECT_EQ(kSampling.step_px(3.34F), 1U);
  EXPECT_EQ((PixelSampling{0.02F, 0.0F}).step_px(0.5F), 1U);
}

TEST(SampledCells, OfNothing) {
  EXPECT_THAT(means_of(sampled_cells(OrganizedCloud(5, 4), {}, kSampling, Se3())), IsEmpty());
}

}  // namespace
}  // namespace credo
