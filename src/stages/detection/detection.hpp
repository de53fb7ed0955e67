#pragma once

#include <vector>

#include "core/belief.hpp"
#include "core/detection.hpp"
#include "core/fields.hpp"
#include "core/object_model.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// The gate between the detector and the belief (thesis 3.1.1).
struct DetectionConfig {
  /// A detection passes within this quantile of the chi-square distribution that its squared
  /// Mahalanobis distance follows.
  double gate_quantile = 0.999;
};
FieldList fields(DetectionConfig& config);

/// One request an object of the belief, in its order; poses in the camera frame.
[[nodiscard]] std::vector<DetectionRequest> detection_requests(BeliefState const& seen,
                                                               Se3 const& T_world_camera);

/// Tells which detection is of which object of `seen`, by type and pose: adds to the segmentation
/// an observation for each object found, in the belief's order, and every other detection as
/// refused. `objects_looked_for` is then true.
///
/// Distances are taken to the pose distributions of `seen`, least over the symmetry of the models
/// (a type without a model has none). Pairs within the gate are matched likeliest first (a vague
/// object is near to everything), ties by object, then by detection; each object and each detection
/// at most once.
///
/// Throws std::runtime_error for a detection that cannot be: a pose or covariance that is not
/// finite, a covariance that is not positive definite.
[[nodiscard]] Segmentation match_detections(Segmentation segmentation, BeliefState const& seen,
                                            std::vector<Detection> const& detections,
                                            ObjectModels const& models,
                                            DetectionConfig const& config);

}  // namespace credo
