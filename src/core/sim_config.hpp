#pragma once

#include <cstdint>

#include "core/fields.hpp"

namespace credo {

/// How a simulated camera measures depth. Estimators assume one of them, so that each can be tested
/// on the other.
enum class SensorModel : std::uint8_t {
  /// Depth as it is.
  kIdeal,
  /// Gaussian noise, axial and lateral, growing with range and incidence (Nguyen et al. 2012).
  kGaussian,
  /// Disparity in steps of an eighth of a pixel, noise before rounding (Barron and Malik 2013).
  kDisparity,
};

/// Which of a simulated scene's sensors is played.
struct SimConfig {
  /// First the scene's own choice, then those of SensorModel.
  enum class Sensor : std::uint8_t { kOfScene, kIdeal, kGaussian, kDisparity };
  Sensor sensor = Sensor::kOfScene;
  int seed = 1;
};
FieldList fields(SimConfig& config);

}  // namespace credo
