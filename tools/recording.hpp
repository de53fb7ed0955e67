#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>

#include "graph/pipeline_config.hpp"

namespace credo {

/// What `credo record` was told to do. It also ends on `stop`, and where the source ends.
struct RecordingOrder {
  /// A URI.
  std::string source;
  std::filesystem::path out;
  std::optional<std::int64_t> frames;
  /// By a sensor's time as it passes here, or by a recording's stamps.
  std::optional<double> seconds;
  PipelineConfig config;
  std::stop_token stop;
};

/// What came of it.
struct Recorded {
  std::int64_t frames = 0;
  std::uint64_t bytes = 0;
  double seconds = 0.0;
  std::map<std::string, std::uint64_t> lost;
  /// For the command that plays it back.
  std::string source;
  std::string settings;
};

/// Into a folder that `dataset:` reads. What cannot be written in time is counted as `slow_disk`
/// where the source is a sensor; others wait. Throws InputError where nothing can be recorded, or
/// no more can be written; what was written stays, and is whole.
Recorded record_folder(RecordingOrder const& order);

/// Into a file that `oni:` reads; `order.source` is a sensor. Ends also when the sensor goes, and
/// before the disk is full. Throws InputError where nothing can be recorded, or the file does not
/// hold what came.
Recorded record_oni(RecordingOrder const& order);

}  // namespace credo
