#pragma once

#include <vector>

#include "core/detection.hpp"
#include "core/detector_config.hpp"
#include "sim/scene.hpp"
#include "sim/scene_caster.hpp"

namespace credo {

/// Stands for the black box of thesis 3.1.1 in a simulated scene: knows where the objects truly are
/// in a frame (from its index alone) and says so with noise. It finds every object of a requested
/// type (type_of), whatever the expected pose, that is visible enough and that it does not miss.
///  - The pose is boxplus(true pose in the camera, e), e ~ N(0, R) with the two sigmas on the
///    diagonal of R, then shifted by the bias. R is the covariance that it tells; a sigma of 0 is
///    told as 1e-6 m or rad, so that R stays positive definite. Each frame draws anew, which it
///    says, too (Detection::errors_repeat); a bias it keeps to itself.
///  - The score is the visible fraction. Of which nothing is visible, that is never found.
///  - False alarms follow the objects: a Poisson number with the type one of those requested, the
///    place uniform in pixels and from 0.5 to 4 m of depth, any rotation, and score and visible
///    fraction alike uniform above the least.
/// What it says of an object depends on the seed, the frame and the object's position in the scene,
/// on no earlier call; the same for the false alarms of the same requested types.
class SimDetector : public Detector {
public:
  /// Throws InputError for a scene that check_scene refuses. The config is in its ranges (fields).
  SimDetector(Scene const& scene, SimDetectorConfig const& config);

  /// In the order of Scene::things, each once however many requests name its type. Nothing without
  /// requests. Takes at least latency_s by the clock.
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

private:
  SceneCaster world_;
  SimDetectorConfig config_;
};

}  // namespace credo
