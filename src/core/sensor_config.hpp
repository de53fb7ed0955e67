#pragma once

#include <cstdint>

#include "core/fields.hpp"

namespace credo {

/// What becomes of a setting of the sensor's colour camera.
enum class SensorSwitch : std::uint8_t { kKeep, kOn, kOff };

/// How depth gets into the colour camera's image.
enum class RegistrationMode : std::uint8_t {
  /// By the sensor; by us where it can't or, as its images tell, doesn't.
  kAuto,
  /// By the sensor; never by us.
  kSensor,
  /// By us, from the calibration.
  kSoftware,
  /// Not at all: colour is then of another place than depth.
  kOff,
};

/// A live sensor (openni:). Settings are applied whenever its streams start, as sensors forget
/// them.
struct SensorConfig {
  RegistrationMode registration = RegistrationMode::kAuto;
  SensorSwitch auto_exposure = SensorSwitch::kKeep;
  SensorSwitch auto_white_balance = SensorSwitch::kKeep;
  /// Of the sensor's own unit; 0 = as it is.
  int exposure = 0;
  int gain = 0;
  /// After so long without depth a sensor is said to be stalled, and after three times that opened
  /// anew.
  double stall_s = 2.0;
  /// ... and so long before its first image.
  double first_frame_s = 10.0;
  /// Between two tries to open a lost sensor, at most; the first come at a quarter of a second.
  double retry_s = 5.0;
};
FieldList fields(SensorConfig& config);

}  // namespace credo
