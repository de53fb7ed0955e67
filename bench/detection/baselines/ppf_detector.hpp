#pragma once

#include <memory>
#include <vector>

#include "core/detection.hpp"
#include "core/object_model.hpp"

namespace credo {

/// To be tuned on the tuning sets.
struct PpfSettings {
  /// Between points of model and scene, as a share of the model's diameter, and at least.
  double spacing_share = 0.08;
  double least_spacing_m = 0.007;
  /// Steps of the pairs' features: of the distance as a share of the diameter; so many of a turn.
  double distance_step_share = 0.06;
  int angle_steps = 31;
  /// Each so many-th point of the scene votes as a reference.
  unsigned reference_step = 5;
  double least_score = 0.5;
};

/// Point-pair voting (Drost et al. 2010) by PCL's PPFRegistration over all that stands on the
/// table, its one pose for each model made better by ICP and judged by how it fits the depth image.
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
