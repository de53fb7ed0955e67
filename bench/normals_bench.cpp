// Normals of whole kitchen frames at full resolution beside PCL's: both of its integral image
// methods, and all points within 3 cm. One thread each. CREDO_DATA names the folder of recordings.
#include <benchmark/benchmark.h>
#include <pcl/features/integral_image_normal.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <tbb/global_control.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <variant>

#include "io/dataset.hpp"
#include "stages/normals/normals.hpp"

namespace credo {
namespace {

constexpr int kLastFrame = 480;

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;
using PclIntegralImage = pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal>;

std::map<int, FramePtr> read_frames() {
  char const* given = std::getenv("CREDO_DATA");  // NOLINT(concurrency-mt-unsafe): before threads
  std::filesystem::path const data = given != nullptr ? given : CREDO_DATA_DIR;
  OpenedSource const opened = open_dataset(data / "kitchen", CaptureConfig{}, PoseConfig{});
  std::map<int, FramePtr> frames;
  for (int i = 0; i <= kLastFrame; ++i) {
    SourceResult const next = opened.source->next();
    if (i % 120 == 0) {
      frames[i] = std::get<FramePtr>(next);
    }
  }
  return frames;
}

Frame const& frame_of(benchmark::State const& state) {
  static std::map<int, FramePtr> const frames = read_frames();
  return *frames.at(static_cast<int>(state.range(0)));
}

/// Keeps the image's order, so that PCL knows who is whose neighbour.
PclCloud::Ptr pcl_cloud_of(OrganizedCloud const& cloud) {
  auto result = std::make_shared<PclCloud>(static_cast<std::uint32_t>(cloud.width()),
                                           static_cast<std::uint32_t>(cloud.height()));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    (*result)[i] = {cloud.x[i], cloud.y[i], cloud.z[i]};
  }
  result->is_dense = false;
  return result;
}

void credo_normals(benchmark::State& state) {
  tbb::global_control const one_thread(tbb::global_control::max_allowed_parallelism, 1);
  Frame const& frame = frame_of(state);
  for (auto step : state) {
    benchmark::DoNotOptimize(
        estimate_normals(frame.cloud_camera, frame.intrinsics, NormalsConfig{}));
  }
}

// Set up as PCL's tutorial on normals from integral images has it. Building the integral images is
// part of the work: PCL needs them anew for each frame.
void pcl_integral_image(benchmark::State& state, PclIntegralImage::NormalEstimationMethod method) {
  PclCloud::Ptr const cloud = pcl_cloud_of(frame_of(state).cloud_camera);
  for (auto step : state) {
    PclIntegralImage estimation;
    estimation.setNormalEstimationMethod(method);
    estimation.setMaxDepthChangeFactor(0.02F);
    estimation.setNormalSmoothingSize(10.0F);
    estimation.setDepthDependentSmoothing(true);
    estimation.setInputCloud(cloud);
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute(normals);
    benchmark::DoNotOptimize(normals);
  }
}

// Includes the kd-tree, which PCL needs anew for each frame.
void pcl_radius_3cm(benchmark::State& state) {
  PclCloud::Ptr const cloud = pcl_cloud_of(frame_of(state).cloud_camera);
  for (auto step : state) {
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    estimation.setRadiusSearch(0.03);
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute(normals);
    benchmark::DoNotOptimize(normals);
  }
}

void frames(benchmark::internal::Benchmark* benchmark) {
  benchmark->DenseRange(0, kLastFrame, 120)->Unit(benchmark::kMillisecond)->ArgName("frame");
}

BENCHMARK(credo_normals)->Apply(frames);
BENCHMARK_CAPTURE(pcl_integral_image, covariance_matrix, PclIntegralImage::COVARIANCE_MATRIX)
    ->Apply(frames);
BENCHMARK_CAPTURE(pcl_integral_image, average_3d_gradient, PclIntegralImage::AVERAGE_3D_GRADIENT)
    ->Apply(frames);
BENCHMARK(pcl_radius_3cm)->Apply(frames)->Iterations(1);

}  // namespace
}  // namespace credo
