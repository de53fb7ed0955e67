#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/detection.hpp"
#include "core/detector_config.hpp"
#include "core/object_model.hpp"
#include "detector/models/prepared_model.hpp"
#include "detector/scenes/search_scene.hpp"
#include "detector/search/joint_detection.hpp"

namespace credo {

/// Why an object has no detection, or that it has one.
enum class ObjectVerdict : std::uint8_t {
  kFound,
  /// Where it is expected something stands before it, or depth is missing: it may well be there.
  kOccluded,
  /// It is expected outside of the image.
  kOutOfView,
  /// Where it is expected the scene is otherwise; or it was expected nowhere.
  kAbsent,
};

struct ObjectAnswer {
  ObjectVerdict verdict = ObjectVerdict::kAbsent;
  /// If found.
  std::optional<Detection> detection;
};

/// Finds known objects in depth alone (thesis chapter 2): around where they are expected, or in all
/// of the frame. Objects whose type has no model are absent.
///
/// With `both`, what is not found where it is expected is searched for in all of the frame, once in
/// `global_every_frames`, beside the pipeline. What that finds is told `global_lag_frames` later,
/// as the frame of that time shows it: the camera's way in between is taken from the poses of its
/// source. The same frames and requests give the same answers; but for a lag of -1, which takes
/// what is ready and waits for nothing.
class BpaDetector : public Detector {
public:
  /// Prepares the models, 0.3 s each, and keeps them nowhere. Throws InputError for a model without
  /// a surface.
  BpaDetector(ObjectModels const& models, BpaConfig config);
  /// With models that are prepared already.
  BpaDetector(PreparedModels models, BpaConfig config);

  /// Scores are probabilities.
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

  /// The same with a word on what is not found: one answer a request, in their order.
  [[nodiscard]] std::vector<ObjectAnswer> answers(Frame const& frame,
                                                  std::vector<DetectionRequest> const& requests);

  [[nodiscard]] PreparedModels const& models() const { return models_; }

private:
  using ScenePtr = std::shared_ptr<SearchScene const>;

  /// What is searched for in all of a frame that has passed.
  struct Job {
    FrameIndex frame{0};
    Se3 T_source_camera;
    /// By object id.
    std::future<std::map<std::string, std::vector<PoseCandidate>>> found;
  };

  [[nodiscard]] SearchModel const* model_of(DetectionRequest const& request) const;
  [[nodiscard]] std::vector<PoseCandidate> candidates_of(DetectionRequest const& request,
                                                         SearchScene const& scene,
                                                         Frame const& frame) const;
  /// For what is not found, once others are.
  void look_again(std::vector<DetectionRequest> const& requests, SearchScene const& scene,
                  std::vector<ObjectCandidates>& objects) const;
  [[nodiscard]] bool is_due(Frame const& frame) const;
  /// Adds what the job has found, followed to this frame.
  void collect(Frame const& frame, SearchScene const& scene,
               std::vector<DetectionRequest> const& requests,
               std::vector<ObjectCandidates>& objects);
  void start_job(Frame const& frame, ScenePtr const& scene,
                 std::vector<DetectionRequest> const& missing,
                 std::vector<std::optional<PoseCandidate>> const& found);

  PreparedModels models_;
  BpaConfig config_;
  std::optional<Job> job_;
};

}  // namespace credo
