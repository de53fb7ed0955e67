#pragma once

#include "core/belief.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/outline.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// A frame, its segmentation and the belief after it, side by side, in the thesis' colours (figures
/// 3-2 to 4-9). Four panels, each half the frame wide and high:
///  - top left the colour image, or the grey depth of a frame without colour; over it the outlines
///    of known objects at their mean poses, dotted where not seen, and of refused detections orange
///  - top right the segmentation over the grey depth, each label in its colour; stuff that the
///    belief knows in the colour of its id
///  - bottom left the belief in 3-D, seen obliquely from behind and above the camera: cyan what the
///    latest cloud has beside floor, walls and stuff; floor red, walls pink with their segments
///    drawn on the floor, stuff purple, yellow, green by id and paler as its probability falls,
///    known objects outlined at their mean pose, in their colours, paler likewise
///  - bottom right the same from above, a line every metre, world x to the right
/// Outlines are those of the objects' models; a type without one is shown by its axes.
/// Deterministic. A frame of less than 2x2 pixels gives an empty picture.
Grid<Rgb> draw_picture(Frame const& frame, Segmentation const& segmentation,
                       BeliefState const& belief, Outlines const& outlines);

}  // namespace credo
