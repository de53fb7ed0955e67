#include "known_objects.hpp"

#include <spdlog/fmt/fmt.h>

#include <set>
#include <utility>

#include "config/yaml_config.hpp"
#include "core/error.hpp"
#include "core/model_file.hpp"
#include "io/mesh_file.hpp"
#include "io/recorded_detections.hpp"
#include "sim/sim_detector.hpp"
#include "source_uri.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

/// Where models of that name are looked for.
std::vector<fs::path> model_folders(fs::path const& folder) {
  return {folder, folder / "models", CREDO_MODELS_DIR};
}

/// Empty where there is none.
fs::path model_called(std::string const& name, fs::path const& folder) {
  for (fs::path const& place : model_folders(folder)) {
    fs::path path = place / (name + ".yaml");
    if (fs::is_regular_file(path)) {
      return path;
    }
  }
  return {};
}

std::string known_models(std::vector<fs::path> const& folders) {
  std::set<std::string> names;
  // Beside a prior lie other things than models, so that folder's are not told.
  for (std::size_t i = 1; i < folders.size(); ++i) {
    std::error_code ignored;
    for (auto const& entry : fs::directory_iterator(folders[i], ignored)) {
      if (entry.path().extension() == ".yaml") {
        names.insert(entry.path().stem().string());
      }
    }
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

fs::path find_model(std::string const& model, fs::path const& prior, std::string const& who) {
  bool const is_path = model.find('/') != std::string::npos || fs::path(model).has_extension();
  if (is_path) {
    fs::path path = prior.parent_path() / model;
    if (!fs::is_regular_file(path)) {
      throw InputError(who + ": model " + path.string() + " is not a file");
    }
    return path;
  }
  if (fs::path path = model_called(model, prior.parent_path()); !path.empty()) {
    return path;
  }
  throw InputError(who + ": no model is called " + model + "; models are " +
                   known_models(model_folders(prior.parent_path())) +
                   ", others are told by their file");
}

ObjectModel load_model(fs::path const& path, std::vector<std::string>& warnings) {
  ModelFile file;
  load_config(fields(file), {path}, {});
  if (file.name.empty()) {
    file.name = path.stem().string();
  }
  std::optional<TriangleMesh> mesh;
  if (!file.mesh.empty()) {
    fs::path const mesh_path = path.parent_path() / file.mesh;
    LoadedMesh loaded = read_mesh(mesh_path, file.unit);
    if (loaded.boundary_edges > 0) {
      warnings.push_back(fmt::format(
          "{}: the mesh is open ({} edges without a triangle on either side) and so has no inside: "
          "what is near its surface (region_growing.open_mesh_distance_m) counts as the object's",
          mesh_path.string(), loaded.boundary_edges));
    }
    mesh = std::move(loaded.mesh);
  }
  return model_of(file, std::move(mesh), path.string());
}

}  // namespace

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

std::optional<ObjectModel> find_known_model(std::string const& name, fs::path const& folder) {
  fs::path const path = model_called(name, folder);
  std::vector<std::string> ignored;  // were told to whoever ran
  return path.empty() ? std::nullopt : std::optional(load_model(path, ignored));
}

std::unique_ptr<Detector> open_detector(DetectorConfig const& config,
                                        std::string const& source_uri) {
  switch (config.kind) {
    case DetectorKind::kNone:
      return nullptr;
    case DetectorKind::kRecorded:
      if (config.file.empty()) {
        throw InputError("detector.kind: recorded needs detector.file");
      }
      return std::make_unique<RecordedDetector>(config.file);
    case DetectorKind::kSim:
      constexpr char const* kScheme = "sim:";
      if (!source_uri.starts_with(kScheme)) {
        throw InputError("detector.kind: sim needs a simulated source, --source " + source_uri +
                         " is none");
      }
      return std::make_unique<SimDetector>(
          load_scene(source_uri.substr(std::string(kScheme).size())), config.sim);
  }
  return nullptr;
}

}  // namespace credo
