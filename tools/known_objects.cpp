#include "known_objects.hpp"

#include <map>
#include <string>
#include <utility>

#include "config/yaml_config.hpp"
#include "core/error.hpp"
#include "dds/remote_detector.hpp"
#include "detector/bpa_detector.hpp"
#include "io/recorded_detections.hpp"
#include "model_files.hpp"
#include "scene_file.hpp"
#include "sim/sim_detector.hpp"

namespace credo {

namespace fs = std::filesystem;

LoadedPrior load_prior(fs::path const& path, double probability) {
  PriorFile file;
  load_config(fields(file), {path}, {});
  LoadedPrior loaded;
  loaded.prior = prior_of(file, probability, path.string());
  std::map<fs::path, std::string> names;  // of the models loaded so far
  for (ObjectBelief& object : loaded.prior.objects) {
    fs::path const model_path =
        find_model(object.type, path, path.string() + ": object " + object.id);
    // Two ways to tell one file are one model.
    auto const [known, is_new] = names.try_emplace(fs::weakly_canonical(model_path));
    if (is_new) {
      ObjectModel model = load_model(model_path, loaded.warnings);
      known->second = model.name;
      if (!loaded.models.try_emplace(model.name, std::move(model)).second) {
        throw InputError(model_path.string() + ": another model is called " + known->second +
                         " too; give it another name");
      }
    }
    object.type = known->second;
  }
  return loaded;
}

std::unique_ptr<Detector> open_detector(DetectorConfig const& config, DdsConfig const& dds,
                                        std::string const& source_uri, ObjectModels const& models,
                                        std::function<void(std::string const&)> tell) {
  switch (config.kind) {
    case DetectorKind::kNone:
      return nullptr;
    case DetectorKind::kRecorded:
      if (config.file.empty()) {
        throw InputError("detector.kind: recorded needs detector.file");
      }
      return std::make_unique<RecordedDetector>(config.file);
    case DetectorKind::kSim: {
      constexpr char const* kScheme = "sim:";
      if (!source_uri.starts_with(kScheme)) {
        throw InputError("detector.kind: sim needs a simulated source, --source " + source_uri +
                         " is none");
      }
      return std::make_unique<SimDetector>(
          load_scene(source_uri.substr(std::string(kScheme).size())), config.sim);
    }
    case DetectorKind::kBpa:
      return std::make_unique<BpaDetector>(
          prepare_models(models, model_cache(config.bpa.cache_dir)), config.bpa);
    case DetectorKind::kRemote:
      return std::make_unique<RemoteDetector>(dds, config.remote, std::move(tell));
  }
  return nullptr;
}

}  // namespace credo
