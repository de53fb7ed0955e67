#include "core/sim_config.hpp"

namespace credo {

FieldList fields(SimConfig& config) {
  return {
      choice("sensor", config.sensor, {"scene", "ideal", "gaussian", "disparity"},
             "how depth is measured: as the scene says, without noise, or by a model of a Kinect"),
      {"seed", &config.seed, {0, 2147483647}, "", "of the sensor's noise"},
  };
}

}  // namespace credo
