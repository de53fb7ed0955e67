#pragma once

#include <string>
#include <vector>

#include "core/belief.hpp"
#include "core/frame.hpp"
#include "core/outline.hpp"
#include "core/segmentation.hpp"
#include "core/truth.hpp"

namespace credo {

/// What a figure of the thesis is run from.
struct Recipe {
  /// A name in scenes/.
  std::string scene;
  /// A name in scenes/priors/; empty: the robot was told nothing.
  std::string prior;
  /// config/thesis.yaml, else the defaults.
  bool thesis_numbers = true;
  /// KEY=VALUE.
  std::vector<std::string> overrides;
};

/// A frame, what the program made of it, and the truth.
struct SceneLook {
  FramePtr frame;
  SegmentationPtr segmentation;
  /// After it.
  BeliefPtr belief;
  FrameTruth truth;
  LabelMap true_labels;
};

struct SceneRun {
  std::vector<SceneLook> looks;
  /// Of the known objects.
  Outlines outlines;
};

/// The command line that gives the same, into the folder `out`.
std::string command_of(Recipe const& recipe, std::string const& out);

/// Throws what a run of the program would end with.
SceneRun run_recipe(Recipe const& recipe);

}  // namespace credo
