#include "ghv_detector.hpp"

#include <pcl/console/print.h>
#include <pcl/recognition/cg/geometric_consistency.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "agreement.hpp"
#include "model_cloud.hpp"
#include "nearby_points.hpp"
#include "refinement.hpp"
#include "scene_cloud.hpp"
#include "shot_keys.hpp"
#include "verification.hpp"

namespace credo {
namespace {

using Poses = std::vector<Eigen::Isometry3f>;

/// Where a viewer stands, evenly over the sphere (a golden spiral), looking at the origin.
Eigen::Isometry3f viewed_from(int view, int views) {
  constexpr float kAway_m = 1.0F;
  float const z = 1.0F - 2.0F * (static_cast<float>(view) + 0.5F) / static_cast<float>(views);
  float const turn =
      std::numbers::pi_v<float> * (3.0F - std::sqrt(5.0F)) * static_cast<float>(view);
  float const r = std::sqrt(1.0F - z * z);
  Eigen::Vector3f const from(r * std::cos(turn), r * std::sin(turn), z);
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.linear() =
      Eigen::Quaternionf::FromTwoVectors(from, -Eigen::Vector3f::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3f(0, 0, kAway_m);
  return pose;
}

/// Each key of the scene with the likest of the model, where it is like enough.
pcl::CorrespondencesPtr matches(ShotKeys const& model, ShotKeys const& scene, float least_cosine) {
  auto result = std::make_shared<pcl::Correspondences>();
  if (model.descriptors.cols() == 0) {
    return result;
  }
  Eigen::MatrixXf const cosines = model.descriptors.transpose() * scene.descriptors;
  for (Eigen::Index i = 0; i < cosines.cols(); ++i) {
    Eigen::Index best = 0;
    float const cosine = cosines.col(i).maxCoeff(&best);
    if (cosine >= least_cosine) {
      result->emplace_back(static_cast<int>(best), static_cast<int>(i), 1.0F - cosine);
    }
  }
  return result;
}

Poses grouped(ShotKeys const& model, ShotKeys const& scene, pcl::CorrespondencesPtr const& matched,
              GhvSettings const& settings) {
  pcl::GeometricConsistencyGrouping<pcl::PointXYZ, pcl::PointXYZ> grouping;
  grouping.setGCSize(settings.consistency_m);
  grouping.setGCThreshold(settings.least_matches);
  grouping.setInputCloud(model.points);
  grouping.setSceneCloud(scene.points);
  grouping.setModelSceneCorrespondences(matched);
  std::vector<Eigen::Matrix4f, Eigen::aligned_allocator<Eigen::Matrix4f>> transforms;
  std::vector<pcl::Correspondences> groups;
  grouping.recognize(transforms, groups);
  std::vector<std::size_t> order(transforms.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return groups[a].size() > groups[b].size(); });
  Poses poses;
  for (std::size_t i = 0; i < std::min(order.size(), settings.hypotheses_per_model); ++i) {
    poses.emplace_back(transforms[order[i]]);
  }
  return poses;
}

VerifiedCloud::Ptr organized(Frame const& frame) {
  OrganizedCloud const& cloud = frame.cloud_camera;
  auto result = std::make_shared<VerifiedCloud>(static_cast<std::uint32_t>(cloud.width()),
                                                static_cast<std::uint32_t>(cloud.height()));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    (*result)[i].getVector3fMap() = Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]);
  }
  result->is_dense = false;
  return result;
}

/// Points where a pose brings them.
VerifiedCloud::Ptr placed(NormalCloud const& points, Eigen::Isometry3f const& pose) {
  auto result = std::make_shared<VerifiedCloud>();
  for (pcl::PointNormal const& point : points) {
    pcl::PointXYZI moved;
    moved.getVector3fMap() = pose * point.getVector3fMap();
    result->push_back(moved);
  }
  return result;
}

/// The best of each model.
std::vector<Detection> one_each(std::vector<Candidate> candidates) {
  std::ranges::stable_sort(candidates, std::greater{}, &Candidate::score);
  std::set<std::string> told;
  std::vector<Detection> detections;
  for (Candidate const& candidate : candidates) {
    if (told.insert(candidate.model).second) {
      detections.push_back(detection_of(candidate));
    }
  }
  return detections;
}

}  // namespace

struct GhvDetector::Model {
  ModelCloud dense;
  SearchedCloud searched;
  NormalCloud::Ptr sparse;
  ShotKeys keys;
};

GhvDetector::GhvDetector(std::vector<ObjectModel> const& models, GhvSettings const& settings)
    : settings_(settings) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  constexpr std::size_t kSparsePoints = 300;
  models_.resize(models.size());
  tbb::parallel_for(std::size_t{0}, models.size(), [&](std::size_t m) {
    Model& made = models_[m];
    made.dense = model_cloud(models[m], settings.surface_m);
    made.searched = searched(made.dense.points);
    made.sparse = first_points(*made.dense.points, kSparsePoints);
    std::vector<ShotKeys> views;
    for (int view = 0; view < settings.views; ++view) {
      NormalCloud::Ptr const seen =
          facing_points(*made.dense.points, viewed_from(view, settings.views));
      views.push_back(shot_keys(*seen, settings.key_spacing_m, settings.radius_m));
    }
    made.keys = joined(views);
  });
}

GhvDetector::~GhvDetector() = default;

std::vector<Candidate> GhvDetector::hypotheses_of(Model const& model, ShotKeys const& keys,
                                                  NormalCloud const& surface,
                                                  SceneCloud const& scene) const {
  std::vector<Candidate> candidates;
  auto const matched = matches(model.keys, keys, settings_.least_cosine);
  for (Eigen::Isometry3f const& guess : grouped(model.keys, keys, matched, settings_)) {
    if (agreement(*model.sparse, guess, scene, settings_.slack_m).score() <
        settings_.least_rough_score) {
      continue;
    }
    Candidate candidate{model.dense.name, fitted(model.searched, guess, surface), 0.0, {}};
    candidate.fit = agreement(*model.dense.points, candidate.pose_camera, scene);
    candidate.score = candidate.fit.score();
    if (candidate.score >= settings_.least_score) {
      candidates.push_back(std::move(candidate));
    }
  }
  return candidates;
}

std::vector<Detection> GhvDetector::detect(Frame const& frame,
                                           std::vector<DetectionRequest> const& requests) {
  std::set<std::string> asked;
  for (DetectionRequest const& request : requests) {
    asked.insert(request.type);
  }
  SceneCloud const scene = scene_cloud(frame);
  NormalCloud::Ptr const surface = thinned(*scene.points, settings_.surface_m);
  ShotKeys const keys = shot_keys(*surface, settings_.key_spacing_m, settings_.radius_m);
  std::vector<std::vector<Candidate>> found(models_.size());
  tbb::parallel_for(std::size_t{0}, models_.size(), [&](std::size_t m) {
    if (asked.contains(models_[m].dense.name) && !keys.points->empty()) {
      found[m] = hypotheses_of(models_[m], keys, *surface, scene);
    }
  });
  std::vector<Candidate> candidates;
  std::vector<VerifiedCloud::ConstPtr> standing;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    for (Candidate const& candidate : found[m]) {
      standing.push_back(placed(*models_[m].dense.points, candidate.pose_camera));
      candidates.push_back(candidate);
    }
  }
  if (candidates.empty()) {
    return {};
  }
  std::vector<bool> const accepted = verified(placed(*surface, Eigen::Isometry3f::Identity()),
                                              organized(frame), standing, settings_.verification);
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (accepted[i]) {
      kept.push_back(candidates[i]);
    }
  }
  return one_each(std::move(kept));
}

}  // namespace credo
