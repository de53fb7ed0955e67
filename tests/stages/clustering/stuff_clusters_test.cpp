#include "stages/clustering/stuff_clusters.hpp"

#include <gmock/gmock.h>

#include <random>

#include "geometry/thinning.hpp"

namespace credo {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr float kSpacing = 0.02F;
PixelSampling const kAllPixels{kSpacing, 0.0F, Eigen::Vector3f::Zero()};

// A slope with stripes of labels, some of them torn, some explained by something else.
struct Scene {
  Scene() : cloud(90, 40), labels(90, 40, kUnassigned) {
    std::mt19937 engine(6);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      Pixel const p = labels.pixel(i);
      cloud.set(i, {0.004F * static_cast<float>(p.u), 0.004F * static_cast<float>(p.v),
                    1.0F + 0.002F * static_cast<float>(p.u + p.v)});
      labels[i] = static_cast<LabelCode>(kFirstStuff + p.v / 10);
      if (engine() % 8 == 0) {
        labels[i] = engine() % 2 == 0 ? kFloor : kFirstStuff + 7;
      }
    }
  }
  [[nodiscard]] std::vector<StuffCluster> clusters() const {
    return stuff_clusters(cloud, stuff_runs(labels), kAllPixels, T_world_camera);
  }

  OrganizedCloud cloud;
  LabelMap labels;
  Se3 T_world_camera;
};

PointList points_with(Scene const& scene, LabelCode label) {
  PointList points;
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    if (scene.labels[i] == label) {
      points.push_back(scene.cloud.at(i));
    }
  }
  return points;
}

TEST(StuffClusters, TellOfAllPixelsOfTheirLabel) {
  Scene const scene;
  std::vector<StuffCluster> const clusters = scene.clusters();
  ASSERT_THAT(clusters, SizeIs(8));
  for (StuffCluster const& cluster : clusters) {
    PointList const points = points_with(scene, cluster.label);
    EXPECT_EQ(cluster.pixel_count, points.size());
    EXPECT_EQ(cluster.points_world, thin_points(points, kSpacing));
    Eigen::AlignedBox3f bounds;
    Eigen::Vector3d sum(0, 0, 0);
    for (Eigen::Vector3f const& point : points) {
      bounds.extend(point);
      sum += point.cast<double>();
    }
    if (!points.empty()) {
      EXPECT_TRUE(cluster.bounds_world.isApprox(bounds, 0.0F));
      EXPECT_TRUE(cluster.centroid_world.isApprox(
          (sum / static_cast<double>(points.size())).cast<float>(), 1e-6F));
    }
  }
}

TEST(StuffClusters, LabelsThatAreNotSeenAreEmpty) {
  Scene const scene;
  std::vector<StuffCluster> const clusters = scene.clusters();
  ASSERT_THAT(clusters, SizeIs(8));
  EXPECT_EQ(clusters[5].label, kFirstStuff + 5);
  EXPECT_EQ(clusters[5].pixel_count, 0U);
  EXPECT_THAT(clusters[5].points_world, IsEmpty());
}

TEST(StuffClusters, CountAllPixelsAndHaveThePointsOfTheFirm) {
  Scene const scene;
  std::vector<StuffRun> runs = stuff_runs(scene.labels);
  // Every third run is apart.
  std::vector<PointList> firm(8);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k].is_firm = k % 3 != 0;
    for (std::size_t i = runs[k].pixels.begin; runs[k].is_firm && i < runs[k].pixels.end; ++i) {
      firm[runs[k].label - std::size_t{kFirstStuff}].push_back(scene.cloud.at(i));
    }
  }
  std::vector<StuffCluster> const clusters =
      stuff_clusters(scene.cloud, runs, kAllPixels, scene.T_world_camera);
  ASSERT_THAT(clusters, SizeIs(8));
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    EXPECT_EQ(clusters[k].pixel_count, points_with(scene, clusters[k].label).size());
    EXPECT_EQ(clusters[k].points_world, thin_points(firm[k], kSpacing));
  }
}

TEST(StuffClusters, OfNothing) {
  EXPECT_THAT(stuff_runs(LabelMap()), IsEmpty());
  EXPECT_THAT(stuff_runs(LabelMap(5, 4, kFloor)), IsEmpty());
  EXPECT_THAT(stuff_clusters({}, {}, kAllPixels, Se3()), IsEmpty());
}

}  // namespace
}  // namespace credo
