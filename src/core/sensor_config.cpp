#include "core/sensor_config.hpp"

namespace credo {

FieldList fields(SensorConfig& config) {
  return {
      choice(
          "registration", config.registration, {"auto", "sensor", "software", "off"},
          "who brings depth into the colour camera's image; auto: the sensor, and software where "
          "it cannot or, as images tell, does not"),
      choice("auto_exposure", config.auto_exposure, {"keep", "on", "off"},
             "of the colour camera; keep: as the sensor has it"),
      choice("auto_white_balance", config.auto_white_balance, {"keep", "on", "off"},
             "of the colour camera; keep: as the sensor has it"),
      {"exposure", &config.exposure, {0, 1e6}, "", "in the sensor's own unit; 0 = as it is"},
      {"gain", &config.gain, {0, 1e6}, "", "in the sensor's own unit; 0 = as it is"},
      {"stall_s",
       &config.stall_s,
       {0.1, 60},
       "s",
       "without depth for so long the sensor is stalled; after three times that it is opened anew"},
      {"first_frame_s",
       &config.first_frame_s,
       {0.1, 600},
       "s",
       "the same before the first image of a sensor"},
      {"retry_s",
       &config.retry_s,
       {0.1, 600},
       "s",
       "longest time between two tries to open a lost sensor"},
  };
}

}  // namespace credo
