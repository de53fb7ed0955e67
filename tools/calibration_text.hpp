#pragma once

#include <string>
#include <vector>

#include "stages/capture/calibration.hpp"

namespace credo {

/// What a calibration was made of.
struct CalibrationOrigin {
  std::string source;
  /// Good frames looked at.
  int frames = 0;
};

/// For people: each value with its spread, then what floor and wall rest on.
std::string calibration_table(Calibration const& calibration, CalibrationOrigin const& origin);

/// The overlay for `--config`: a comment that says what it was made of, and pose.level: given with
/// its camera_*, to a micrometre and a microradian.
std::string calibration_yaml(Calibration const& calibration, CalibrationOrigin const& origin);

/// A line for each reason to doubt it.
std::vector<std::string> calibration_warnings(Calibration const& calibration,
                                              CalibrationOrigin const& origin);

}  // namespace credo
