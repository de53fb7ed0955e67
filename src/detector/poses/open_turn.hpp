#pragma once

#include <vector>

#include "core/se3.hpp"
#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/poses/polishing.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// What a frame leaves open of a pose beyond its neighbourhood: the handle of a mug may be anywhere
/// behind it.
struct OpenTurn {
  /// Amid all turns that explain the frame about as well.
  CameraPose pose;
  /// How they spread about it, as boxplus takes it in the camera frame, each as likely as it is
  /// beside the others: along an arc, for the line that they turn about lies beside the model's
  /// origin, and about a line that is itself not known exactly. 0 where only one turn does.
  Matrix6d covariance = Matrix6d::Zero();
};

/// Follows the turn that the frame tells least of, by `information` (of boxplus errors at the
/// model's origin, camera frame, positive definite), from the pose on to both sides as long as
/// verification takes it for about as likely. A turn that is told to 0.02 radians is not followed,
/// nor any of a model with a symmetry axis: there it changes nothing.
[[nodiscard]] OpenTurn open_turn(SearchModel const& model, SearchScene const& scene,
                                 CameraPose const& pose, Matrix6d const& information);

/// The other turns about the same line, all around, that explain the frame best: at most six,
/// polished, each more than 20 degrees from the candidate's own. A model that is all but round is
/// found by its roundness, whichever way its handle is. None where open_turn follows none.
[[nodiscard]] std::vector<PoseCandidate> other_turns(SearchModel const& model,
                                                     SearchScene const& scene,
                                                     PoseCandidate const& candidate,
                                                     Matrix6d const& information);

}  // namespace credo
