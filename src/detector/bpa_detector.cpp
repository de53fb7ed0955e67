#include "detector/bpa_detector.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>

#include "detector/poses/pose_covariance.hpp"
#include "detector/poses/symmetry_twin.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/search/tracking.hpp"

namespace credo {
namespace {

constexpr std::size_t kMaxCandidates = 8;
/// Around an expected pose there is little to choose from.
constexpr std::size_t kMaxTracked = 2;
/// How well a pose found a few frames ago is known now: by what the camera's source strays.
constexpr double kFollowed_m = 0.010;
constexpr double kFollowed_rad = 0.03;
/// What an object that is so likely explains, others are not looked for on.
constexpr float kKnown = 0.5F;
/// An object is hidden where so much of it is, and no more than that is seen through.
constexpr float kHiddenShare = 0.6F;
constexpr float kSeenThroughShare = 0.15F;

/// A number for the draws of one object in one frame.
std::uint64_t seed_of(BpaConfig const& config, Frame const& frame, std::string const& object_id) {
  std::uint64_t mixed = static_cast<std::uint64_t>(config.seed) * 1000003U +
                        static_cast<std::uint64_t>(number(frame.index));
  for (char const letter : object_id) {
    mixed = mixed * 1099511628211ULL + static_cast<unsigned char>(letter);
  }
  return mixed;
}

PoseDistribution followed(CameraPose const& pose, Se3 const& T_now_then) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(kFollowed_m * kFollowed_m);
  covariance.diagonal().tail<3>().setConstant(kFollowed_rad * kFollowed_rad);
  return {T_now_then * se3(pose), covariance};
}

ObjectVerdict verdict_at(SearchModel const& model, SearchScene const& scene, Se3 const& expected) {
  Verification const view = verified(model, scene, camera_pose(expected), {});
  auto const shown = static_cast<float>(view.shown_px());
  if (view.shown_px() == 0) {
    return ObjectVerdict::kOutOfView;
  }
  bool const hidden = static_cast<float>(view.occluded_px + view.behind_plane_px +
                                         view.no_depth_px) >= kHiddenShare * shown &&
                      static_cast<float>(view.seen_through_px) <= kSeenThroughShare * shown;
  return hidden ? ObjectVerdict::kOccluded : ObjectVerdict::kAbsent;
}

Detection detection_of(SearchModel const& model, SearchScene const& scene,
                       PoseCandidate const& candidate, std::string const& type) {
  Detection detection;
  detection.type = type;
  detection.pose_camera = with_covariance(model, scene, best_twin(model, scene, candidate.pose));
  detection.score = static_cast<double>(candidate.probability);
  detection.visible_fraction = static_cast<double>(candidate.verification.visible_fraction);
  return detection;
}

ObjectAnswer answer_of(DetectionRequest const& request, SearchModel const* model,
                       std::optional<PoseCandidate> const& found, SearchScene const& scene) {
  if (model == nullptr) {
    return {};
  }
  if (!found) {
    return {verdict_at(*model, scene, request.expected_camera.mean), std::nullopt};
  }
  return {ObjectVerdict::kFound, detection_of(*model, scene, *found, request.type)};
}

/// What has a model and no pose.
std::vector<DetectionRequest> missing(std::vector<DetectionRequest> const& requests,
                                      std::vector<ObjectCandidates> const& objects,
                                      std::vector<std::optional<PoseCandidate>> const& found) {
  std::vector<DetectionRequest> missing;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (objects[i].model != nullptr && !found[i]) {
      missing.push_back(requests[i]);
    }
  }
  return missing;
}

}  // namespace

BpaDetector::BpaDetector(ObjectModels const& models, BpaConfig config)
    : BpaDetector(prepare_models(models), std::move(config)) {}

BpaDetector::BpaDetector(PreparedModels models, BpaConfig config)
    : models_(std::move(models)), config_(std::move(config)) {}

std::vector<Detection> BpaDetector::detect(Frame const& frame,
                                           std::vector<DetectionRequest> const& requests) {
  std::vector<Detection> detections;
  for (ObjectAnswer& answer : answers(frame, requests)) {
    if (answer.detection) {
      detections.push_back(std::move(*answer.detection));
    }
  }
  return detections;
}

std::vector<ObjectAnswer> BpaDetector::answers(Frame const& frame,
                                               std::vector<DetectionRequest> const& requests) {
  auto const scene = std::make_shared<SearchScene const>(scene_of(frame));
  std::vector<ObjectCandidates> objects;
  objects.reserve(requests.size());
  for (DetectionRequest const& request : requests) {
    objects.push_back({model_of(request), candidates_of(request, *scene, frame)});
  }
  auto const least = static_cast<float>(config_.min_probability);
  if (is_due(frame)) {
    collect(frame, *scene, requests, objects);
  }
  if (config_.search == ObjectSearch::kGlobal) {
    look_again(requests, *scene, objects);
  }
  std::vector<std::optional<PoseCandidate>> found = choose_jointly(objects, *scene, least);
  start_job(frame, scene, missing(requests, objects, found), found);
  if (config_.global_lag_frames == 0 && is_due(frame)) {
    collect(frame, *scene, requests, objects);
    found = choose_jointly(objects, *scene, least);
  }
  std::vector<ObjectAnswer> answers;
  answers.reserve(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    answers.push_back(answer_of(requests[i], objects[i].model, found[i], *scene));
  }
  return answers;
}

SearchModel const* BpaDetector::model_of(DetectionRequest const& request) const {
  auto const found = models_.find(request.type);
  return found != models_.end() ? &found->second->model : nullptr;
}

std::vector<PoseCandidate> BpaDetector::candidates_of(DetectionRequest const& request,
                                                      SearchScene const& scene,
                                                      Frame const& frame) const {
  SearchModel const* model = model_of(request);
  if (model == nullptr) {
    return {};
  }
  if (config_.search == ObjectSearch::kGlobal) {
    return search_everywhere(*model, models_.at(request.type)->pairs, scene, kMaxCandidates);
  }
  if (!can_track(*model, request.expected_camera)) {
    return {};
  }
  return search_near(*model, scene, request.expected_camera,
                     seed_of(config_, frame, request.object_id), kMaxTracked);
}

void BpaDetector::look_again(std::vector<DetectionRequest> const& requests,
                             SearchScene const& scene,
                             std::vector<ObjectCandidates>& objects) const {
  auto const known = choose_jointly(objects, scene, kKnown);
  if (std::ranges::none_of(known, [](auto const& pose) { return pose.has_value(); })) {
    return;
  }
  ClaimedPixels const explained = explained_by(known, scene, kKnown);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (objects[i].model != nullptr && !known[i]) {
      objects[i].candidates =
          search_again(*objects[i].model, models_.at(requests[i].type)->pairs, scene,
                       std::move(objects[i].candidates), explained, kMaxCandidates);
    }
  }
}

bool BpaDetector::is_due(Frame const& frame) const {
  if (!job_) {
    return false;
  }
  if (config_.global_lag_frames < 0) {
    return job_->found.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }
  return number(frame.index) - number(job_->frame) >= config_.global_lag_frames;
}

void BpaDetector::collect(Frame const& frame, SearchScene const& scene,
                          std::vector<DetectionRequest> const& requests,
                          std::vector<ObjectCandidates>& objects) {
  Se3 const T_now_then = frame.T_source_camera.inverse() * job_->T_source_camera;
  auto const found = job_->found.get();
  job_.reset();
  for (std::size_t i = 0; i < requests.size(); ++i) {
    auto const of_object = found.find(requests[i].object_id);
    if (of_object == found.end()) {
      continue;
    }
    for (PoseCandidate const& candidate : of_object->second) {
      for (PoseCandidate& now :
           search_near(*objects[i].model, scene, followed(candidate.pose, T_now_then),
                       seed_of(config_, frame, requests[i].object_id), 1)) {
        objects[i].candidates.push_back(std::move(now));
      }
    }
  }
}

void BpaDetector::start_job(Frame const& frame, ScenePtr const& scene,
                            std::vector<DetectionRequest> const& missing,
                            std::vector<std::optional<PoseCandidate>> const& found) {
  bool const turn = number(frame.index) % config_.global_every_frames == 0;
  if (config_.search != ObjectSearch::kBoth || job_ || !turn || missing.empty()) {
    return;
  }
  auto search = [scene, missing, models = models_,
                 explained = explained_by(found, *scene, kKnown)] {
    std::map<std::string, std::vector<PoseCandidate>> candidates;
    for (DetectionRequest const& request : missing) {
      PreparedModel const& model = *models.at(request.type);
      candidates[request.object_id] =
          search_everywhere(model.model, model.pairs, *scene, kMaxCandidates, explained);
    }
    return candidates;
  };
  job_ = Job{frame.index, frame.T_source_camera, std::async(std::launch::async, search)};
}

}  // namespace credo
