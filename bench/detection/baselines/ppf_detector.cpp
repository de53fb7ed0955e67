#include "ppf_detector.hpp"

#include <pcl/console/print.h>
#include <pcl/features/ppf.h>
#include <pcl/registration/ppf_registration.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>

#include "agreement.hpp"
#include "model_cloud.hpp"
#include "nearby_points.hpp"
#include "refinement.hpp"
#include "scene_cloud.hpp"
#include "scene_segments.hpp"

namespace credo {

struct PpfDetector::Model {
  double spacing_m = 0.0;
  ModelCloud dense;
  SearchedCloud searched;
  NormalCloud::Ptr sparse;
  pcl::PPFHashMapSearch::Ptr pairs;
};

namespace {

/// So many of a segment's points tell how much of it is on a model.
constexpr std::size_t kShared = 200;

/// The pose of the model at a segment that has the most votes.
template <typename Model>
std::optional<Eigen::Isometry3f> voted(Model const& model, NormalCloud const& segment,
                                       PpfSettings const& settings) {
  constexpr std::size_t kLeastPoints = 6;
  NormalCloud::Ptr const points = thinned(segment, model.spacing_m);
  if (points->size() < kLeastPoints) {
    return std::nullopt;
  }
  pcl::PPFRegistration<pcl::PointNormal, pcl::PointNormal> voting;
  voting.setSceneReferencePointSamplingRate(settings.reference_step);
  voting.setPositionClusteringThreshold(static_cast<float>(0.1 * model.dense.diameter_m));
  voting.setRotationClusteringThreshold(static_cast<float>(20.0 * std::numbers::pi / 180.0));
  voting.setSearchMethod(model.pairs);
  voting.setInputSource(model.sparse);
  voting.setInputTarget(points);
  NormalCloud moved;
  voting.align(moved);
  Eigen::Isometry3f pose;
  pose.matrix() = voting.getFinalTransformation();
  if (!pose.matrix().allFinite()) {
    return std::nullopt;
  }
  pose.linear() = Eigen::Quaternionf(pose.linear()).normalized().toRotationMatrix();
  return pose;
}

}  // namespace

PpfDetector::PpfDetector(std::vector<ObjectModel> const& models, PpfSettings const& settings)
    : settings_(settings) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  constexpr double kDense_m = 0.006;
  for (ObjectModel const& model : models) {
    Model made;
    made.dense = model_cloud(model, kDense_m);
    made.searched = searched(made.dense.points);
    double const diameter_m = made.dense.diameter_m;
    made.spacing_m = std::max(settings.least_spacing_m, settings.spacing_share * diameter_m);
    made.sparse = model_cloud(model, made.spacing_m).points;
    pcl::PPFEstimation<pcl::PointNormal, pcl::PointNormal, pcl::PPFSignature> estimation;
    estimation.setInputCloud(made.sparse);
    estimation.setInputNormals(made.sparse);
    auto const features = std::make_shared<pcl::PointCloud<pcl::PPFSignature>>();
    estimation.compute(*features);
    // A hair less than a whole part of a turn: PCL's array has then a place for each step.
    auto const angle_step =
        static_cast<float>(2.0 * std::numbers::pi / (settings.angle_steps + 1e-3));
    made.pairs = std::make_shared<pcl::PPFHashMapSearch>(
        angle_step, static_cast<float>(settings.distance_step_share * diameter_m));
    made.pairs->setInputFeatureCloud(features);
    models_.push_back(std::move(made));
  }
}

PpfDetector::~PpfDetector() = default;

std::vector<Detection> PpfDetector::detect(Frame const& frame,
                                           std::vector<DetectionRequest> const& requests) {
  constexpr double kSurface_m = 0.005;
  std::set<std::string> asked;
  for (DetectionRequest const& request : requests) {
    asked.insert(request.type);
  }
  SceneCloud const scene = scene_cloud(frame);
  NormalCloud::Ptr const surface = thinned(*scene.points, kSurface_m);
  std::vector<SegmentCloud> const segments = segments_of(scene);
  std::vector<std::vector<Candidate>> found(models_.size());
  tbb::parallel_for(std::size_t{0}, models_.size(), [&](std::size_t m) {
    Model const& model = models_[m];
    if (!asked.contains(model.dense.name)) {
      return;
    }
    for (SegmentCloud const& segment : segments) {
      if (!segment.could_be(model.dense.diameter_m)) {
        continue;
      }
      auto const guess = voted(model, *segment.points, settings_);
      if (!guess) {
        continue;
      }
      Eigen::Isometry3f const pose = fitted(model.searched, *guess, *surface);
      Candidate candidate{model.dense.name, pose, 0.0, agreement(*model.dense.points, pose, scene)};
      candidate.score =
          candidate.fit.score() *
          share_on_model(*first_points(*segment.points, kShared), model.searched, pose);
      found[m].push_back(std::move(candidate));
    }
  });
  std::vector<Candidate> candidates;
  for (auto& of_model : found) {
    candidates.insert(candidates.end(), of_model.begin(), of_model.end());
  }
  return best_candidates(std::move(candidates), settings_.least_score);
}

}  // namespace credo
