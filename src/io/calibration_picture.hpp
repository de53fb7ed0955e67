#pragma once

#include "core/frame.hpp"
#include "core/label.hpp"

namespace credo {

/// What a calibrated camera sees, in colour where that is registered to depth, else depth as grey:
/// the floor red, walls pink, over them the world's floor as lines a metre apart and its axes at
/// the origin. `labels` is as large as the frame's cloud. A frame without pixels gives an empty
/// picture.
Grid<Rgb> draw_calibration(Frame const& frame, LabelMap const& labels, Se3 const& T_world_camera);

}  // namespace credo
