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

FieldList fields(BpaConfig& config) {
  return {
      choice(
          "search", config.search, {"tracked", "global", "both"},
          "around where the belief expects an object, in the whole frame, or there only for what "
          "is not found where it is expected"),
      {"min_probability",
       &config.min_probability,
       {0, 1},
       "",
       "a pose less likely right than this is no detection"},
      {"global_every_frames",
       &config.global_every_frames,
       {1, 100000},
       "frames",
       "what is not found where it is expected is looked for everywhere once in so many"},
      {"global_lag_frames",
       &config.global_lag_frames,
       {-1, 1000},
       "frames",
       "what is found everywhere is told so much later; the search runs beside the pipeline "
       "meanwhile; 0: the frame waits; -1: as soon as it is done (live)"},
      {"seed", &config.seed, {0, 1e9}, "", "of all random choices"},
      {"cache_dir",
       &config.cache_dir,
       {},
       "",
       "models made ready are kept in this folder; auto: credo in $XDG_CACHE_HOME, else in "
       "~/.cache; empty: nowhere"},
  };
}

FieldList fields(RemoteDetectorConfig& config) {
  return {
      {"timeout_s",
       &config.timeout_s,
       {0, 3600},
       "s",
       "a frame that is not answered so long says nothing about known objects"},
  };
}

FieldList fields(DetectorConfig& config) {
  return {
      choice("kind", config.kind, {"none", "recorded", "sim", "bpa", "remote"},
             "nobody, a file of recorded detections, a simulated scene's own truth, Bingham "
             "Procrustean alignment, or another process over DDS"),
      {"file", &config.file, {}, "", "recorded detections, JSON lines (kind: recorded)"},
      section("sim", fields(config.sim), "how far the simulated detector strays from the truth"),
      section("bpa", fields(config.bpa), "Bingham Procrustean alignment: models found in depth"),
      section("remote", fields(config.remote), "a detector in another process, over DDS"),
  };
}

}  // namespace credo
