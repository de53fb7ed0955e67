#include "nearby_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace credo {
namespace {

/// At most so many points go into ICP.
constexpr std::size_t kMostPoints = 150;
/// The model's normal and the scene's agree to a cosine of so much.
constexpr float kSameSide = 0.5F;

/// From a model's origin to its farthest point.
float reach_m_of(NormalCloud const& model) {
  float reach_m = 0.0F;
  for (pcl::PointNormal const& point : model) {
    reach_m = std::max(reach_m, point.getVector3fMap().norm());
  }
  return reach_m;
}

NormalCloud::Ptr near_model(SearchedCloud const& model, Eigen::Isometry3f const& pose,
                            NormalCloud const& scene, double distance_m) {
  Eigen::Isometry3f const T_model_camera = pose.inverse();
  float const reach_m = reach_m_of(*model.points) + static_cast<float>(distance_m);
  auto near = std::make_shared<NormalCloud>();
  pcl::Indices nearest(1);
  std::vector<float> distance2_m(1);
  for (pcl::PointNormal const& point : scene) {
    if ((point.getVector3fMap() - pose.translation()).norm() > reach_m) {
      continue;
    }
    pcl::PointNormal in_model;
    in_model.getVector3fMap() = T_model_camera * Eigen::Vector3f(point.getVector3fMap());
    model.tree->nearestKSearch(in_model, 1, nearest, distance2_m);
    auto const& surface = (*model.points)[static_cast<std::size_t>(nearest[0])];
    Eigen::Vector3f const normal =
        T_model_camera.linear() * Eigen::Vector3f(point.getNormalVector3fMap());
    if (distance2_m[0] < distance_m * distance_m &&
        surface.getNormalVector3fMap().dot(normal) > kSameSide) {
      near->push_back(point);
    }
  }
  std::size_t const step = 1 + near->size() / kMostPoints;
  auto few = std::make_shared<NormalCloud>();
  for (std::size_t i = 0; i < near->size(); i += step) {
    few->push_back((*near)[i]);
  }
  return few;
}

}  // namespace

NormalCloud::Ptr thinned(NormalCloud const& points, double cell_m) {
  std::set<std::array<int, 3>> taken;
  auto kept = std::make_shared<NormalCloud>();
  for (pcl::PointNormal const& point : points) {
    Eigen::Vector3i const cell =
        (point.getVector3fMap() / static_cast<float>(cell_m)).array().floor().cast<int>();
    if (taken.insert({cell.x(), cell.y(), cell.z()}).second) {
      kept->push_back(point);
    }
  }
  return kept;
}

Eigen::Isometry3f fitted(SearchedCloud const& model, Eigen::Isometry3f const& pose_camera,
                         NormalCloud const& scene) {
  constexpr int kIterations = 8;
  Eigen::Isometry3f pose = pose_camera;
  for (double const distance_m : {0.02, 0.01}) {
    pose =
        refined(near_model(model, pose, scene, distance_m), model, pose, {kIterations, distance_m});
  }
  return pose;
}

}  // namespace credo
