// Table tops held apart (OSD), beside PCL's two ways: supervoxels joined where convex (LCCP), and
// connected components of what stands on the largest plane. Each method takes all clouds, one
// thread; of each cloud the median of its runs counts. `ms` is the median over the clouds of CPU
// time, the rest means of the scores that `credo eval` has. CREDO_DATA names the folder of
// recordings.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <pcl/features/integral_image_normal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/euclidean_cluster_comparator.h>
#include <pcl/segmentation/lccp_segmentation.h>
#include <pcl/segmentation/organized_connected_component_segmentation.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>
#include <pcl/segmentation/supervoxel_clustering.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <vector>

#include "cpu_time.hpp"
#include "eval/evaluation.hpp"
#include "io/pcd.hpp"
#include "stages/segments/segments.hpp"

namespace credo {
namespace {

using ColoredPoint = pcl::PointXYZRGBA;
using PclPoint = pcl::PointXYZ;
using Numbers = std::vector<std::uint32_t>;

constexpr double kFocal_px = 525.0;

/// The same cloud as each method wants it.
struct TableTop {
  OrganizedCloud cloud;
  LabelMap true_labels;
  pcl::PointCloud<ColoredPoint>::Ptr colored;
  pcl::PointCloud<PclPoint>::Ptr points;
};

TableTop read_table_top(std::filesystem::path const& file) {
  constexpr double kFarthest_m = 10.0;
  TableTop top{read_pcd(file, CloudAxes::kOptical, kFarthest_m).cloud_camera,
               read_pcd_labels(file).value(), nullptr, nullptr};
  auto const width = static_cast<std::uint32_t>(top.cloud.width());
  auto const height = static_cast<std::uint32_t>(top.cloud.height());
  top.colored = std::make_shared<pcl::PointCloud<ColoredPoint>>(width, height);
  top.points = std::make_shared<pcl::PointCloud<PclPoint>>(width, height);
  for (std::size_t i = 0; i < top.cloud.size(); ++i) {
    (*top.points)[i] = {top.cloud.x[i], top.cloud.y[i], top.cloud.z[i]};
    (*top.colored)[i].getVector3fMap() = (*top.points)[i].getVector3fMap();
  }
  top.points->is_dense = false;
  top.colored->is_dense = false;
  return top;
}

std::vector<TableTop> read_table_tops() {
  char const* given = std::getenv("CREDO_DATA");  // NOLINT(concurrency-mt-unsafe): before threads
  std::filesystem::path const data = given != nullptr ? given : CREDO_DATA_DIR;
  std::vector<TableTop> tops;
  for (auto const& entry : std::filesystem::directory_iterator(data / "osd")) {
    if (entry.path().extension() == ".pcd") {
      tops.push_back(read_table_top(entry.path()));
    }
  }
  return tops;
}

/// Any numbers as labels of segments; `none` is no segment.
LabelMap label_map(TableTop const& top, Numbers const& numbers, std::uint32_t none) {
  LabelMap labels(top.cloud.width(), top.cloud.height(), kUnassigned);
  std::map<std::uint32_t, LabelCode> label_of;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (top.cloud.valid(i) && numbers[i] != none) {
      auto const next = static_cast<LabelCode>(kFirstStuff + label_of.size());
      labels[i] = label_of.try_emplace(numbers[i], next).first->second;
    }
  }
  return labels;
}

Numbers credo_segments(TableTop const& top) {
  Segments const segments = convex_segments(top.cloud.z, kFocal_px, {});
  return {segments.labels.begin(), segments.labels.end()};
}

/// With the values of PCL's own example but for the resolutions, which are the best on OSD.
Numbers pcl_lccp(TableTop const& top) {
  constexpr float kVoxel_m = 0.005F;
  constexpr float kSeed_m = 0.02F;
  pcl::SupervoxelClustering<ColoredPoint> clustering(kVoxel_m, kSeed_m);
  clustering.setUseSingleCameraTransform(false);
  clustering.setInputCloud(top.colored);
  clustering.setColorImportance(0.0F);
  clustering.setSpatialImportance(1.0F);
  clustering.setNormalImportance(4.0F);
  std::map<std::uint32_t, pcl::Supervoxel<ColoredPoint>::Ptr> supervoxels;
  clustering.extract(supervoxels);
  std::multimap<std::uint32_t, std::uint32_t> neighbours;
  clustering.getSupervoxelAdjacency(neighbours);
  pcl::LCCPSegmentation<ColoredPoint> joining;
  joining.setConcavityToleranceThreshold(10.0F);
  joining.setSanityCheck(true);
  joining.setSmoothnessCheck(true, kVoxel_m, kSeed_m, 0.1F);
  joining.setKFactor(1);  // extended convexity
  joining.setInputSupervoxels(supervoxels, neighbours);
  joining.setMinSegmentSize(3);
  joining.segment();
  auto const labelled = clustering.getLabeledCloud();
  joining.relabelCloud(*labelled);
  Numbers numbers(labelled->size());
  std::ranges::transform(*labelled, numbers.begin(), [](auto const& p) { return p.label; });
  return numbers;
}

/// The pixels of the largest plane; set up as PCL's demo of organised segmentation has it.
std::vector<int> largest_plane(TableTop const& top) {
  pcl::IntegralImageNormalEstimation<PclPoint, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(0.02F);
  estimation.setNormalSmoothingSize(20.0F);
  estimation.setInputCloud(top.points);
  auto const normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  estimation.compute(*normals);
  pcl::OrganizedMultiPlaneSegmentation<PclPoint, pcl::Normal, pcl::Label> search;
  search.setMinInliers(10000);
  search.setAngularThreshold(3.0 * std::numbers::pi / 180.0);
  search.setDistanceThreshold(0.02);
  search.setInputNormals(normals);
  search.setInputCloud(top.points);
  std::vector<pcl::PlanarRegion<PclPoint>, Eigen::aligned_allocator<pcl::PlanarRegion<PclPoint>>>
      regions;
  std::vector<pcl::ModelCoefficients> coefficients;
  std::vector<pcl::PointIndices> inliers;
  auto labels = std::make_shared<pcl::PointCloud<pcl::Label>>();
  std::vector<pcl::PointIndices> label_indices;
  std::vector<pcl::PointIndices> boundaries;
  search.segmentAndRefine(regions, coefficients, inliers, labels, label_indices, boundaries);
  auto const largest = std::ranges::max_element(
      inliers, {}, [](pcl::PointIndices const& plane) { return plane.indices.size(); });
  return largest == inliers.end() ? std::vector<int>{} : largest->indices;
}

Numbers pcl_organised(TableTop const& top) {
  constexpr std::uint32_t kThePlane = std::numeric_limits<std::uint32_t>::max() - 1;
  auto const is_plane = std::make_shared<pcl::PointCloud<pcl::Label>>();
  is_plane->resize(top.points->size());
  std::vector<int> const plane = largest_plane(top);
  for (int const i : plane) {
    (*is_plane)[static_cast<std::size_t>(i)].label = 1;
  }
  auto const comparator = std::make_shared<pcl::EuclideanClusterComparator<PclPoint, pcl::Label>>();
  comparator->setInputCloud(top.points);
  comparator->setLabels(is_plane);
  // By its code the labels of this set are those that count.
  comparator->setExcludeLabels(std::make_shared<std::set<std::uint32_t>>(std::set{0U}));
  comparator->setDistanceThreshold(0.01F, false);
  pcl::OrganizedConnectedComponentSegmentation<PclPoint, pcl::Label> search(comparator);
  search.setInputCloud(top.points);
  pcl::PointCloud<pcl::Label> labels;
  std::vector<pcl::PointIndices> label_indices;
  search.segment(labels, label_indices);
  Numbers numbers(labels.size());
  std::ranges::transform(labels, numbers.begin(), [](auto const& p) { return p.label; });
  for (int const i : plane) {
    numbers[static_cast<std::size_t>(i)] = kThePlane;
  }
  return numbers;
}

void table_tops(benchmark::State& state, Numbers (*method)(TableTop const&), int runs,
                std::uint32_t none) {
  static std::vector<TableTop> const tops = read_table_tops();
  // As the program does: freed memory stays with the process.
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  std::vector<double> medians_ms;
  LabelEvaluation evaluation;
  for (auto step : state) {
    for (TableTop const& top : tops) {
      std::vector<double> runs_ms;
      Numbers numbers;
      for (int run = 0; run < runs; ++run) {
        double const begin_ms = thread_cpu_ms();
        numbers = method(top);
        runs_ms.push_back(thread_cpu_ms() - begin_ms);
      }
      medians_ms.push_back(median(runs_ms));
      evaluation.add(label_map(top, numbers, none), top.true_labels);
    }
  }
  state.counters["ms"] = median(medians_ms);
  state.counters["ms_max"] = *std::ranges::max_element(medians_ms);
  auto const scores = evaluation.scores().segmentation.instances.value();
  state.counters["WOv"] = scores.weighted_overlap;
  state.counters["F_os"] = scores.over_segmentation;
  state.counters["F_us"] = scores.under_segmentation;
  state.counters["recall"] = scores.recall_50;
}

constexpr std::uint32_t kNoLabel = std::numeric_limits<std::uint32_t>::max();

BENCHMARK_CAPTURE(table_tops, credo, credo_segments, 15, 0)->Iterations(1);
BENCHMARK_CAPTURE(table_tops, pcl_lccp, pcl_lccp, 3, 0)->Iterations(1);
BENCHMARK_CAPTURE(table_tops, pcl_organised, pcl_organised, 5, kNoLabel)->Iterations(1);

}  // namespace
}  // namespace credo
