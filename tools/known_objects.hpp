#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/dds_config.hpp"
#include "core/detection.hpp"
#include "core/detector_config.hpp"
#include "core/object_model.hpp"
#include "core/prior_file.hpp"

namespace credo {

/// What `--prior` names, with the models that it names.
struct LoadedPrior {
  Prior prior;
  ObjectModels models;
  /// Each one line for people.
  std::vector<std::string> warnings;
};

/// Reads a prior and its models. A model is a file, told by its path from the prior's folder, or a
/// name: NAME.yaml beside the prior, in a folder models/ there, or in models/ of this project.
/// Throws InputError with one line for the first fault, or for all of one file's.
LoadedPrior load_prior(std::filesystem::path const& path, double probability);

/// The detector that the config asks for, of objects that look like `models`; null for `none`. One
/// in another process is asked as `dds` says; what befalls it is told line by line, from the thread
/// that asks. Throws InputError where it cannot be had: a file that is not right, `sim` for a
/// source that is no scene, a model that `bpa` cannot see, DDS that does not start.
std::unique_ptr<Detector> open_detector(DetectorConfig const& config, DdsConfig const& dds,
                                        std::string const& source_uri, ObjectModels const& models,
                                        std::function<void(std::string const&)> tell);

}  // namespace credo
