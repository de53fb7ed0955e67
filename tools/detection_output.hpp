#pragma once

#include <string>
#include <vector>

#include "core/detection.hpp"
#include "core/object_model.hpp"

namespace credo {

/// A list of {"type","position","orientation_xyzw","score","visible_fraction","covariance"}, camera
/// frame, metres and radians; ends with a line feed.
std::string detections_json(std::vector<Detection> const& detections);

/// For people: a line for each model, with the place, deviations and probability of what was found,
/// or that it was not found.
std::string detection_table(ObjectModels const& models, std::vector<Detection> const& detections);

}  // namespace credo
