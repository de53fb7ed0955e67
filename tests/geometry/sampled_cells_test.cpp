#include "geometry/sampled_cells.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "geometry/thinning.hpp"

namespace credo {
namespace {

using ::testing::IsEmpty;

constexpr float kFocal_px = 500.0F;
PixelSampling const kSampling{0.02F, kFocal_px, Eigen::Vector3f::Zero()};

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
    PixelSteps const steps = every_pixel ? PixelSteps{} : kSampling.steps_px(cloud.at(run.begin));
    for (std::size_t i = run.begin; i < run.end; ++i) {
      Pixel const p = cloud.z.pixel(i);
      if (static_cast<std::size_t>(p.u) % steps.u == 0 &&
          static_cast<std::size_t>(p.v) % steps.v == 0) {
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
  EXPECT_EQ(means_of(sampled_cells(large, torn_runs(large),
                                   {kSampling.spacing_m, 0.0F, Eigen::Vector3f::Zero()}, Se3())),
            thin_points(literal_points(large, torn_runs(large), true), kSampling.spacing_m));
}

// A cable along an odd row, which no sample of every second row shows.
TEST(SampledCells, KeepWhatIsOnePixelWide) {
  OrganizedCloud const cloud = slope(640, 9, 1.0F, 1.0F);
  std::vector<PixelRun> const cable = {{640 * 3, 640 * 4}};
  EXPECT_GT(sampled_cells(cloud, cable, kSampling, Se3()).cell_count(), 50U);
}

TEST(SampledCells, HaveOneAndAHalfPixelsASideOrMoreOfWhatFacesTheCamera) {
  auto const steps_at = [](float depth_m) { return kSampling.steps_px({0.1F, 0.2F, depth_m}); };
  EXPECT_EQ(steps_at(1.66F), (PixelSteps{4, 4}));
  EXPECT_EQ(steps_at(1.67F), (PixelSteps{2, 2}));
  EXPECT_EQ(steps_at(3.33F), (PixelSteps{2, 2}));
  EXPECT_EQ(steps_at(3.34F), (PixelSteps{1, 1}));
  EXPECT_EQ((PixelSampling{0.02F, 0.0F, Eigen::Vector3f::Zero()}).steps_px({0.0F, 0.0F, 0.5F}),
            (PixelSteps{1, 1}));
}

/// Where the ray through a place of the image meets a plane.
Eigen::Vector3f seen_at(Plane const& plane, double u, double v) {
  Eigen::Vector3d const ray(u / kFocal_px, v / kFocal_px, 1.0);
  return (ray * (plane.offset_m / plane.normal.dot(ray))).cast<float>();
}

// Steps are as wide as they may be, and no wider: of points on planes, however they are turned.
TEST(SampledCells, HaveOneAndAHalfPixelsASideOfAPlaneAtAnyAngle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int seen = 0;
  int unlike = 0;
  for (int k = 0; k < 2000; ++k) {
    Plane const plane{Eigen::Vector3d(any(random), any(random), any(random)).normalized(),
                      1.0 + any(random)};
    double const u = 200.0 * any(random);
    double const v = 200.0 * any(random);
    Eigen::Vector3f const p = seen_at(plane, u, v);
    if (!(p.z() > 0.3F && p.z() < 5.0F)) {
      continue;
    }
    ++seen;
    PixelSteps const steps =
        PixelSampling::of_plane(kSampling.spacing_m, kFocal_px, plane).steps_px(p);
    // A short way along the image, by which no more than by a pixel the scale changes.
    constexpr double kWay_px = 0.01;
    double const apart_u_m = (seen_at(plane, u + kWay_px, v) - p).norm() / kWay_px;
    double const apart_v_m = (seen_at(plane, u, v + kWay_px) - p).norm() / kWay_px;
    for (auto const& [step, apart_m] : {std::pair(steps.u, apart_u_m), {steps.v, apart_v_m}}) {
      double const most = kSampling.spacing_m / 1.5 / apart_m;
      std::size_t const widest = most >= 4.2 ? 4 : most >= 2.1 ? 2 : 1;
      std::size_t const least = most >= 3.8 && most < 4.2   ? 2
                                : most >= 1.9 && most < 2.1 ? 1
                                                            : widest;
      EXPECT_GE(step, least);
      EXPECT_LE(static_cast<double>(step), 1.05 * std::max(most, 1.0));
    }
    unlike += steps.u == steps.v ? 0 : 1;
  }
  EXPECT_GT(seen, 500);
  EXPECT_GT(unlike, 100);
}

TEST(SampledCells, OfAPlaneThatTheCameraIsInAreThoseOfAllPixels) {
  Plane const plane{Eigen::Vector3d::UnitY(), 0.0};
  EXPECT_EQ(PixelSampling::of_plane(0.02F, kFocal_px, plane).steps_px({0.1F, 0.0F, 0.5F}).v, 1U);
}

TEST(SampledCells, OfNothing) {
  EXPECT_THAT(means_of(sampled_cells(OrganizedCloud(5, 4), {}, kSampling, Se3())), IsEmpty());
}

}  // namespace
}  // namespace credo
