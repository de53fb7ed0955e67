#pragma once

#include <string>
#include <vector>

#include "core/scores.hpp"
#include "eval/evaluation.hpp"

namespace credo {

/// SVG: of the claims with about the same probability, how many were true, beside the diagonal that
/// a calibrated belief lies on; the area of a dot tells how many there were.
std::string reliability_plot(ExistenceScores const& scores);

/// SVG, one strip each over the frames: weighted overlap of the segments, tilt of the floor, errors
/// of the known objects, their probabilities. Frames where something was not to be had leave gaps;
/// a strip without anything is left out. Where an object is not where it is believed to be, its
/// line is dashed.
std::string frames_plot(std::vector<FrameScores> const& trace);

}  // namespace credo
