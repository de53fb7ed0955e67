#include "icp_detector.hpp"

#include <pcl/common/centroid.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>

#include "agreement.hpp"
#include "scene_cloud.hpp"
#include "scene_segments.hpp"

namespace credo {
namespace {

constexpr std::size_t kCoarseModelPoints = 250;
constexpr std::size_t kFineModelPoints = 2000;

/// The model turned so, what it shows to the camera about the segment's middle.
Eigen::Isometry3f start_pose(NormalCloud const& model, Eigen::Quaternionf const& turn,
                             Eigen::Vector3f const& middle) {
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.linear() = turn.toRotationMatrix();
  pose.translation() = middle;
  Eigen::Vector4f shown;
  pcl::compute3DCentroid(*facing_points(model, pose), shown);
  pose.translation() = middle - turn * shown.head<3>();
  return pose;
}

struct Tried {
  Eigen::Isometry3f pose;
  double score = 0.0;
};

/// The poses of the best scores, best first.
std::vector<Eigen::Isometry3f> best_of(std::vector<Tried> tried, std::size_t count) {
  std::ranges::stable_sort(tried, std::greater{}, &Tried::score);
  tried.resize(std::min(tried.size(), count));
  std::vector<Eigen::Isometry3f> poses;
  for (Tried const& one : tried) {
    poses.push_back(one.pose);
  }
  return poses;
}

}  // namespace

IcpDetector::IcpDetector(std::vector<ObjectModel> const& models, IcpSettings const& settings)
    : settings_(settings) {
  for (ObjectModel const& model : models) {
    Model made{model_cloud(model, settings.model_spacing_m), {}, {}, {}, {}};
    made.searched = searched(made.cloud.points);
    made.turns = spread_turns(model.symmetry, settings.turns_apart_deg);
    made.coarse = first_points(*made.cloud.points, kCoarseModelPoints);
    made.fine = first_points(*made.cloud.points, kFineModelPoints);
    models_.push_back(std::move(made));
  }
}

std::vector<Candidate> IcpDetector::fits_of(Model const& model, SegmentCloud const& segment,
                                            SceneCloud const& scene) const {
  auto const coarse = first_points(*segment.points, settings_.coarse_points);
  std::vector<Tried> tried;
  for (Eigen::Quaternionf const& turn : model.turns) {
    Eigen::Isometry3f const start = start_pose(*model.coarse, turn, segment.middle);
    Eigen::Isometry3f const pose = refined(coarse, model.searched, start, settings_.coarse);
    tried.push_back({pose, agreement(*model.coarse, pose, scene).score() *
                               share_on_model(*coarse, model.searched, pose)});
  }
  auto const fine = first_points(*segment.points, settings_.fine_points);
  std::vector<Candidate> candidates;
  for (Eigen::Isometry3f const& rough : best_of(std::move(tried), settings_.finalists)) {
    Candidate candidate{
        model.cloud.name, refined(fine, model.searched, rough, settings_.fine), 0.0, {}};
    candidate.fit = agreement(*model.fine, candidate.pose_camera, scene);
    candidate.score =
        candidate.fit.score() * share_on_model(*fine, model.searched, candidate.pose_camera);
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

std::vector<Detection> IcpDetector::detect(Frame const& frame,
                                           std::vector<DetectionRequest> const& requests) {
  std::set<std::string> asked;
  for (DetectionRequest const& request : requests) {
    asked.insert(request.type);
  }
  SceneCloud const scene = scene_cloud(frame);
  std::vector<SegmentCloud> const segments = segments_of(scene);
  std::vector<std::vector<Candidate>> found(models_.size());
  tbb::parallel_for(std::size_t{0}, models_.size(), [&](std::size_t m) {
    Model const& model = models_[m];
    if (!asked.contains(model.cloud.name)) {
      return;
    }
    for (SegmentCloud const& segment : segments) {
      if (segment.could_be(model.cloud.diameter_m)) {
        std::vector<Candidate> const fits = fits_of(model, segment, scene);
        found[m].insert(found[m].end(), fits.begin(), fits.end());
      }
    }
  });
  std::vector<Candidate> candidates;
  for (auto const& of_model : found) {
    candidates.insert(candidates.end(), of_model.begin(), of_model.end());
  }
  return best_candidates(std::move(candidates), settings_.least_score);
}

}  // namespace credo
