#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/detection.hpp"
#include "core/frame.hpp"
#include "core/object_model.hpp"
#include "eval/detection_scorer.hpp"
#include "sim/tabletop.hpp"
#include "sim/tabletop_sets.hpp"

namespace credo {

/// One picture of a set, and what is truly in it.
struct TableView {
  std::string scene;
  FramePtr frame;
  std::vector<TrueInstance> truths;
};

/// All models of the sets: the household's and those of LINEMOD-Occlusion. Throws InputError where
/// the latter are not in `recordings`.
[[nodiscard]] std::vector<ObjectModel> all_models(std::filesystem::path const& recordings);

/// The frozen scenes of a set, as committed. Throws InputError for a file that is not there.
[[nodiscard]] std::vector<TabletopScene> frozen_scenes(TabletopSet const& set);
/// The file that they are in.
[[nodiscard]] std::filesystem::path frozen_file(TabletopSet const& set);

/// Frame `number` of a run: rendered with the noise of the scene's own seed.
[[nodiscard]] TableView view_of(TabletopScene const& scene, ObjectModels const& models, int number);

/// Every model, anywhere: a metre ahead, give or take metres, any turn.
[[nodiscard]] std::vector<DetectionRequest> requests_for(std::vector<ObjectModel> const& models);

}  // namespace credo
