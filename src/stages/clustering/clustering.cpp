#include "stages/clustering/clustering.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/reachability.hpp"
#include "geometry/thinning.hpp"
#include "stages/clustering/label_spreading.hpp"

namespace credo {
namespace {

using Components = Grid<std::int32_t>;

void check(Frame const& frame, NormalMap const& normals, Segmentation const& segmentation) {
  Grid<float> const& depth = frame.cloud_camera.z;
  if (!depth.same_size(normals.z) || !depth.same_size(segmentation.labels)) {
    throw std::logic_error("cluster_stuff: a cloud of " + std::to_string(depth.width()) + "x" +
                           std::to_string(depth.height()) +
                           " pixels needs normals and labels of that size");
  }
  if (!segmentation.stuff.empty()) {
    throw std::logic_error("cluster_stuff: the segmentation already holds " +
                           std::to_string(segmentation.stuff.size()) + " clusters of stuff");
  }
}

Components unexplained_components(Frame const& frame, NormalMap const& normals,
                                  LabelMap const& labels, ClusteringConfig const& config) {
  Grid<std::uint8_t> unexplained(labels.width(), labels.height());
  std::transform(labels.begin(), labels.end(), unexplained.begin(),
                 [](LabelCode label) { return static_cast<std::uint8_t>(label == kUnassigned); });
  return connected_components(frame.cloud_camera, normals, unexplained,
                              {.radius_m = static_cast<float>(config.radius_m),
                               .max_angle_rad = static_cast<float>(config.max_angle_rad)});
}

std::vector<std::size_t> sizes_of(Components const& components) {
  std::vector<std::size_t> sizes;
  for (std::int32_t const component : components) {
    if (component != kNoComponent) {
      auto const id = static_cast<std::size_t>(component);
      if (id == sizes.size()) {
        sizes.push_back(0);
      }
      ++sizes[id];
    }
  }
  return sizes;
}

// The label of each component: those that are large enough, the largest if there are too many, by
// first pixel.
std::vector<LabelCode> labels_of(std::vector<std::size_t> const& sizes, std::size_t min_pixels) {
  std::vector<std::size_t> kept(sizes.size());
  std::iota(kept.begin(), kept.end(), 0U);
  std::erase_if(kept, [&](std::size_t id) { return sizes[id] < min_pixels; });
  if (kept.size() > kMaxStuff) {
    std::stable_sort(kept.begin(), kept.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    kept.resize(kMaxStuff);
    std::sort(kept.begin(), kept.end());
  }
  std::vector<LabelCode> labels(sizes.size(), kUnassigned);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    labels[kept[i]] = static_cast<LabelCode>(kFirstStuff + i);
  }
  return labels;
}

// World points of each label of stuff, in raster order.
std::vector<PointList> points_by_label(OrganizedCloud const& cloud, LabelMap const& labels,
                                       Se3 const& T_world_camera) {
  std::vector<std::size_t> counts;
  for (LabelCode const label : labels) {
    if (is_stuff(label)) {
      std::size_t const i = label - kFirstStuff;
      counts.resize(std::max(counts.size(), i + 1));
      ++counts[i];
    }
  }
  std::vector<PointList> points(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    points[i].reserve(counts[i]);
  }
  Eigen::Matrix3f const rotation = T_world_camera.rotation().toRotationMatrix().cast<float>();
  Eigen::Vector3f const translation = T_world_camera.translation().cast<float>();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (is_stuff(labels[i])) {
      points[labels[i] - kFirstStuff].emplace_back(rotation * cloud.at(i) + translation);
    }
  }
  return points;
}

StuffCluster cluster_of(PointList const& points_world, LabelCode label, float spacing_m) {
  StuffCluster cluster;
  cluster.label = label;
  cluster.pixel_count = points_world.size();
  cluster.points_world = thin_points(points_world, spacing_m);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Vector3f const& point : points_world) {
    sum += point.cast<double>();
    cluster.bounds_world.extend(point);
  }
  // Rounding must not push the centroid of a flat cluster out of its bounds.
  Eigen::Vector3f const mean = (sum / static_cast<double>(points_world.size())).cast<float>();
  cluster.centroid_world =
      mean.cwiseMax(cluster.bounds_world.min()).cwiseMin(cluster.bounds_world.max());
  return cluster;
}

}  // namespace

FieldList fields(ClusteringConfig& config) {
  return {
      {"radius_m", &config.radius_m, {0.001, 1}, "m", "points join within this distance"},
      {"max_angle_rad",
       &config.max_angle_rad,
       {0, 3.14},
       "rad",
       "... if their normals differ by less than this"},
      {"min_pixels", &config.min_pixels, {1, 1e7}, "pixels", "smaller clusters are ignored"},
      {"spread_px",
       &config.spread_px,
       {0, 1000},
       "pixels",
       "pixels without a normal take the label of what they touch, up to this far"},
      {"point_spacing_m",
       &config.point_spacing_m,
       {0.001, 1},
       "m",
       "spacing of a cluster's points in the belief"},
  };
}

Segmentation cluster_stuff(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                           ClusteringConfig const& config) {
  check(frame, normals, segmentation);
  LabelMap& labels = segmentation.labels;
  Components const components = unexplained_components(frame, normals, labels, config);
  std::vector<LabelCode> const label =
      labels_of(sizes_of(components), static_cast<std::size_t>(std::max(config.min_pixels, 1)));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (components[i] != kNoComponent) {
      labels[i] = label[static_cast<std::size_t>(components[i])];
    }
  }
  labels = spread_labels(frame.cloud_camera, normals, std::move(labels),
                         static_cast<float>(config.radius_m), config.spread_px);
  auto const points = points_by_label(frame.cloud_camera, labels, segmentation.T_world_camera);
  for (std::size_t i = 0; i < points.size(); ++i) {
    segmentation.stuff.push_back(cluster_of(points[i], static_cast<LabelCode>(kFirstStuff + i),
                                            static_cast<float>(config.point_spacing_m)));
  }
  return segmentation;
}

}  // namespace credo
