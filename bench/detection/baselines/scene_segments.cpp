#include "scene_segments.hpp"

#include <pcl/common/centroid.h>

#include <algorithm>
#include <random>

namespace credo {
namespace {

constexpr std::size_t kLeastPoints = 25;

double extent_m_of(NormalCloud const& points) {
  constexpr std::size_t kSample = 150;
  double widest_m = 0.0;
  auto const sample = first_points(points, kSample);
  for (auto const& a : *sample) {
    for (auto const& b : *sample) {
      widest_m = std::max<double>(widest_m, (a.getVector3fMap() - b.getVector3fMap()).norm());
    }
  }
  return widest_m;
}

}  // namespace

bool SegmentCloud::could_be(double diameter_m) const {
  constexpr double kLargestShare = 1.15;
  constexpr double kSmallestShare = 0.3;
  return extent_m <= kLargestShare * diameter_m && extent_m >= kSmallestShare * diameter_m;
}

std::vector<SegmentCloud> segments_of(SceneCloud const& scene) {
  std::vector<SegmentCloud> all(static_cast<std::size_t>(scene.segment_count));
  for (SegmentCloud& segment : all) {
    segment.points = std::make_shared<NormalCloud>();
  }
  for (std::size_t i = 0; i < scene.points->size(); ++i) {
    all[static_cast<std::size_t>(scene.segment[i])].points->push_back((*scene.points)[i]);
  }
  std::erase_if(all, [](SegmentCloud const& one) { return one.points->size() < kLeastPoints; });
  for (SegmentCloud& segment : all) {
    std::mt19937_64 random(1);
    std::ranges::shuffle(segment.points->points, random);
    Eigen::Vector4f middle;
    pcl::compute3DCentroid(*segment.points, middle);
    segment.middle = middle.head<3>();
    segment.extent_m = extent_m_of(*segment.points);
  }
  return all;
}

double share_on_model(NormalCloud const& segment, SearchedCloud const& model,
                      Eigen::Isometry3f const& pose_camera) {
  constexpr float kNear_m = 0.01F;
  pcl::Indices nearest(1);
  std::vector<float> distance2_m(1);
  double near = 0.0;
  Eigen::Isometry3f const T_model_camera = pose_camera.inverse();
  for (pcl::PointNormal point : segment) {
    point.getVector3fMap() = T_model_camera * Eigen::Vector3f(point.getVector3fMap());
    model.tree->nearestKSearch(point, 1, nearest, distance2_m);
    near += std::max(0.0F, 1.0F - distance2_m[0] / (kNear_m * kNear_m));
  }
  return near / static_cast<double>(segment.size());
}

}  // namespace credo
