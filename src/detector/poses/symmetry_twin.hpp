#pragma once

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// Of a pose and those that the model's symmetry takes for the same, refined, the one whose surface
/// lies nearest to the scene's (least mean squared residual): what was scanned is symmetric to
/// millimetres only, and a pose the wrong way round would be off by those. The pose as it is where
/// no other lies nearer by a tenth, as of what is truly symmetric, and where nothing of it is seen.
[[nodiscard]] CameraPose best_twin(SearchModel const& model, SearchScene const& scene,
                                   CameraPose const& pose);

}  // namespace credo
