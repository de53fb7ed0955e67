// Clusters of whole kitchen frames at full resolution, 5 cm and 0.3 rad, beside PCL's clusters of
// the same points and normals. CREDO_DATA names the folder of recordings.
#include <benchmark/benchmark.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/extract_clusters.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/reachability/reachability.hpp"
#include "io/dataset.hpp"
#include "stages/clustering/clustering.hpp"
#include "stages/normals/normals.hpp"

namespace credo {
namespace {

constexpr int kLastFrame = 480;

struct Input {
  FramePtr frame;
  NormalMap normals;
};

std::map<int, Input> read_inputs() {
  char const* given = std::getenv("CREDO_DATA");  // NOLINT(concurrency-mt-unsafe): before threads
  std::filesystem::path const data = given != nullptr ? given : CREDO_DATA_DIR;
  OpenedSource const opened = open_dataset(data / "kitchen", CaptureConfig{}, PoseConfig{});
  std::map<int, Input> inputs;
  for (int i = 0; i <= kLastFrame; ++i) {
    SourceResult const next = opened.source->next();
    if (i % 120 == 0) {
      auto const& frame = std::get<FramePtr>(next);
      inputs[i] = {
          .frame = frame,
          .normals = estimate_normals(frame->cloud_camera, frame->intrinsics, NormalsConfig{})};
    }
  }
  return inputs;
}

Input const& input_of(benchmark::State const& state) {
  static std::map<int, Input> const inputs = read_inputs();
  return inputs.at(static_cast<int>(state.range(0)));
}

void credo_clusters(benchmark::State& state) {
  Input const& input = input_of(state);
  OrganizedCloud const& cloud = input.frame->cloud_camera;
  Grid<std::uint8_t> const everything(cloud.width(), cloud.height(), 1);
  for (auto step : state) {
    benchmark::DoNotOptimize(
        connected_components(cloud, input.normals, everything, ReachabilityLimits{}));
  }
}

// Everything the stage does: clusters, labels of pixels without normals, points in the world.
void credo_stage(benchmark::State& state) {
  Input const& input = input_of(state);
  Segmentation const before = unassigned_segmentation(*input.frame, Se3(), kPriorFrame);
  for (auto step : state) {
    state.PauseTiming();
    Segmentation segmentation = before;
    state.ResumeTiming();
    benchmark::DoNotOptimize(
        cluster_stuff(*input.frame, input.normals, std::move(segmentation), ClusteringConfig{}));
  }
}

// Includes the kd-tree, which PCL needs anew for each frame; not the packing of its input.
void pcl_clusters(benchmark::State& state) {
  Input const& input = input_of(state);
  auto const cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::PointCloud<pcl::Normal> normals;
  for (std::size_t i = 0; i < input.normals.size(); ++i) {
    if (input.frame->cloud_camera.valid(i) && input.normals.valid(i)) {
      Eigen::Vector3f const point = input.frame->cloud_camera.at(i);
      Eigen::Vector3f const normal = input.normals.at(i);
      cloud->emplace_back(point.x(), point.y(), point.z());
      normals.emplace_back(normal.x(), normal.y(), normal.z());
    }
  }
  for (auto step : state) {
    pcl::KdTree<pcl::PointXYZ>::Ptr const tree =
        std::make_shared<pcl::KdTreeFLANN<pcl::PointXYZ>>();
    tree->setInputCloud(cloud);
    std::vector<pcl::PointIndices> clusters;
    pcl::extractEuclideanClusters<pcl::PointXYZ, pcl::Normal>(*cloud, normals, 0.05F, tree,
                                                              clusters, 0.3);
    benchmark::DoNotOptimize(clusters);
  }
}

void frames(benchmark::internal::Benchmark* benchmark) {
  benchmark->DenseRange(0, kLastFrame, 120)->Unit(benchmark::kMillisecond)->ArgName("frame");
}

BENCHMARK(credo_clusters)->Apply(frames);
BENCHMARK(credo_stage)->Apply(frames);
BENCHMARK(pcl_clusters)->Apply(frames)->Iterations(1);

}  // namespace
}  // namespace credo
