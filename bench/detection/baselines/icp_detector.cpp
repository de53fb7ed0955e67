#include "icp_detector.hpp"

#include <pcl/common/centroid.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <random>
#include <set>

#include "agreement.hpp"
#include "scene_cloud.hpp"

namespace credo {
namespace {

constexpr std::size_t kCoarseModelPoints = 250;
constexpr std::size_t kFineModelPoints = 2000;
constexpr std::size_t kLeastSegmentPoints = 25;

/// A segment's points in random order.
struct Segment {
  NormalCloud::Ptr points;
  Eigen::Vector3f middle;
  double extent_m = 0.0;
};

std::vector<Segment> segments_of(SceneCloud const& scene) {
  std::vector<Segment> all(static_cast<std::size_t>(scene.segment_count));
  for (Segment& segment : all) {
    segment.points = std::make_shared<NormalCloud>();
  }
  for (std::size_t i = 0; i < scene.points->size(); ++i) {
    all[static_cast<std::size_t>(scene.segment[i])].points->push_back((*scene.points)[i]);
  }
  std::erase_if(all, [](Segment const& one) { return one.points->size() < kLeastSegmentPoints; });
  for (Segment& segment : all) {
    std::mt19937_64 random(1);
    std::ranges::shuffle(segment.points->points, random);
    Eigen::Vector4f middle;
    pcl::compute3DCentroid(*segment.points, middle);
    segment.middle = middle.head<3>();
    // From a sample: the widest of some pairs.
    auto const sample = first_points(*segment.points, 150);
    for (auto const& a : *sample) {
      for (auto const& b : *sample) {
        segment.extent_m =
            std::max<double>(segment.extent_m, (a.getVector3fMap() - b.getVector3fMap()).norm());
      }
    }
  }
  return all;
}

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

/// Share of a segment's points that are on the model.
double share_on_model(NormalCloud const& segment, SearchedCloud const& model,
                      Eigen::Isometry3f const& pose) {
  constexpr float kNear_m = 0.01F;
  pcl::Indices nearest(1);
  std::vector<float> distance2_m(1);
  std::size_t near = 0;
  Eigen::Isometry3f const T_model_camera = pose.inverse();
  for (pcl::PointNormal point : segment) {
    point.getVector3fMap() = T_model_camera * Eigen::Vector3f(point.getVector3fMap());
    model.tree->nearestKSearch(point, 1, nearest, distance2_m);
    near += distance2_m[0] < kNear_m * kNear_m ? 1 : 0;
  }
  return static_cast<double>(near) / static_cast<double>(segment.size());
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

std::vector<Detection> IcpDetector::detect(Frame const& frame,
                                           std::vector<DetectionRequest> const& requests) {
  std::set<std::string> asked;
  for (DetectionRequest const& request : requests) {
    asked.insert(request.type);
  }
  SceneCloud const scene = scene_cloud(frame);
  std::vector<Segment> const segments = segments_of(scene);
  std::vector<std::vector<Candidate>> found(models_.size());
  tbb::parallel_for(std::size_t{0}, models_.size(), [&](std::size_t m) {
    Model const& model = models_[m];
    if (!asked.contains(model.cloud.name)) {
      return;
    }
    for (Segment const& segment : segments) {
      if (segment.extent_m > settings_.largest_share * model.cloud.diameter_m ||
          segment.extent_m < settings_.smallest_share * model.cloud.diameter_m) {
        continue;
      }
      auto const coarse = first_points(*segment.points, settings_.coarse_points);
      std::vector<Tried> tried;
      for (Eigen::Quaternionf const& turn : model.turns) {
        Eigen::Isometry3f const pose =
            refined(coarse, model.searched, start_pose(*model.coarse, turn, segment.middle),
                    settings_.coarse);
        tried.push_back({pose, agreement(*model.coarse, pose, scene).score() *
                                   share_on_model(*coarse, model.searched, pose)});
      }
      std::ranges::stable_sort(tried, std::greater{}, &Tried::score);
      tried.resize(std::min(tried.size(), settings_.finalists));
      auto const fine = first_points(*segment.points, settings_.fine_points);
      for (Tried const& one : tried) {
        Candidate candidate{
            model.cloud.name, refined(fine, model.searched, one.pose, settings_.fine), 0.0, {}};
        candidate.fit = agreement(*model.fine, candidate.pose_camera, scene);
        candidate.score =
            candidate.fit.score() * share_on_model(*fine, model.searched, candidate.pose_camera);
        found[m].push_back(std::move(candidate));
      }
    }
  });
  std::vector<Candidate> candidates;
  for (auto& of_model : found) {
    candidates.insert(candidates.end(), of_model.begin(), of_model.end());
  }
  return best_candidates(std::move(candidates), settings_.least_score);
}

}  // namespace credo
