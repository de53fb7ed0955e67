#include "core/detector_config.hpp"

namespace credo {

FieldList fields(SimDetectorConfig& config) {
  return {
      {"sigma_position_m",
       &config.sigma_position_m,
       {0, 1},
       "m",
       "standard deviation of a position's error along each axis"},
      {"sigma_rotation_rad",
       &config.sigma_rotation_rad,
       {0, 3},
       "rad",
       "standard deviation of a rotation's error about each axis"},
      {"bias_position_m",
       NumbersTarget{&config.bias_position_m, 3, 3},
       {-10, 10},
       "m",
       "added to every position, along the world's axes"},
      {"miss_probability",
       &config.miss_probability,
       {0, 1},
       "",
       "that something in view is not found"},
      {"false_alarms_per_frame",
       &config.false_alarms_per_frame,
       {0, 100},
       "",
       "mean number of detections of things that are not there"},
      {"min_visible_fraction",
       &config.min_visible_fraction,
       {0, 1},
       "",
       "what shows a smaller part of itself is not found"},
      {"latency_s",
       &config.latency_s,
       {0, 60},
       "s",
       "each call takes at least so long; no result depends on it"},
      {"seed", &config.seed, {0, 1e9}, "", "of all errors, misses and false alarms"},
  };
}

FieldList fields(DetectorConfig& config) {
  return {
      choice("kind", config.kind, {"none", "recorded", "sim"},
             "nobody, a file of recorded detections, or a simulated scene's own truth"),
      {"file", &config.file, {}, "", "recorded detections, JSON lines (kind: recorded)"},
      section("sim", fields(config.sim), "how far the simulated detector strays from the truth"),
  };
}

}  // namespace credo
