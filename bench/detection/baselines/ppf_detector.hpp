#pragma once

#include <vector>

#include "core/detection.hpp"
#include "core/object_model.hpp"
#include "model_cloud.hpp"
#include "refinement.hpp"

namespace credo {

/// Tuned on the tuning sets.
struct PpfSettings {
  /// Between points of model and segment, as a share of the model's diameter, and at least.
  double spacing_share = 0.08;
  double least_spacing_m = 0.007;
  /// Steps of the pairs' features: of the distance as a share of the diameter; so many of a turn.
  double distance_step_share = 0.05;
  int angle_steps = 29;
  /// Each so many-th point of a segment votes as a reference.
  unsigned reference_step = 3;
  double least_score = 0.65;
};

/// Point-pair voting (Drost et al. 2010) by PCL's PPFRegistration, every model at every segment of
/// its size; its one pose for each is made better by ICP and judged by how it fits the depth image.
class PpfDetector : public Detector {
public:
  explicit PpfDetector(std::vector<ObjectModel> const& models, PpfSettings const& settings = {});
  PpfDetector(PpfDetector const&) = delete;
  PpfDetector& operator=(PpfDetector const&) = delete;
  PpfDetector(PpfDetector&&) = delete;
  PpfDetector& operator=(PpfDetector&&) = delete;
  ~PpfDetector() override;
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

private:
  struct Model;
  std::vector<Model> models_;
  PpfSettings settings_;
};

}  // namespace credo
