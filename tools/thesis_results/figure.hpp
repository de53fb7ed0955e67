#pragma once

#include <cstddef>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "scene_run.hpp"

namespace credo {

// Panels of the thesis' figures, all of one size. Those in 3-D are seen from one place in all looks
// of a run: behind and above where its first look was taken, so many times enlarged.

/// The camera's picture.
Grid<Rgb> color_panel(SceneLook const& look);
/// The first look's point cloud in the camera's colours.
Grid<Rgb> cloud_panel(SceneRun const& run, double zoom);
/// The same segmented: known objects cyan with the outlines of the poses detected.
Grid<Rgb> segmentation_panel(SceneRun const& run, double zoom);
/// The belief after a look over what that look left unexplained.
Grid<Rgb> belief_panel(SceneRun const& run, std::size_t look, double zoom);

/// Panels in rows, each with its letter in the corner: (a), (b), ...
Grid<Rgb> mounted(std::vector<Grid<Rgb>> const& panels, int columns);

}  // namespace credo
