#pragma once

#include <vector>

#include "core/capture_config.hpp"
#include "core/sensor_config.hpp"
#include "doctor/finding.hpp"
#include "doctor/sensor_measurement.hpp"

namespace credo {

/// Whether images come, in time, all of them, and colour with depth.
std::vector<Finding> stream_findings(SensorMeasurement const& measured);

/// Whether its images are of use: depth, colour, registration, focal length. Only where images
/// came.
std::vector<Finding> image_findings(SensorMeasurement const& measured, CaptureConfig const& capture,
                                    SensorConfig const& config);

/// Where the floor is, or what stands in for it. Only where images came.
std::vector<Finding> floor_findings(ImageEvidence const& evidence, PoseConfig const& pose);

}  // namespace credo
