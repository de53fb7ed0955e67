#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "core/belief.hpp"
#include "core/frame.hpp"
#include "io/image.hpp"
#include "io/metrics.hpp"

namespace credo {

/// The `--out` folder of one run: belief.jsonl, metrics.json, config.yaml, labels/ and pictures/.
/// Files of an earlier run in the same folder are replaced; anything else in it is left alone.
/// Every failure to write throws InputError that names the file.
class RunFolder {
public:
  /// Creates the folder and what it needs inside.
  RunFolder(std::filesystem::path folder, bool with_labels, bool with_pictures,
            std::string const& config_yaml);

  /// Appends a line and hands it to the system, so that a kill loses no finished frame.
  void write_belief(std::string const& json_line);
  void write_labels(FrameIndex frame, EncodedPng const& labels) const;
  void write_picture(FrameIndex frame, EncodedPng const& picture) const;
  /// Written beside and renamed, so that a reader never sees half of it.
  void write_metrics(RunMetrics const& metrics) const;

private:
  std::filesystem::path folder_;
  std::ofstream beliefs_;
};

}  // namespace credo
