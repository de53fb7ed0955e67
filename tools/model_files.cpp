#include "model_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <utility>

#include "config/yaml_config.hpp"
#include "core/error.hpp"
#include "core/model_file.hpp"
#include "io/mesh_file.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

/// Where models of that name are looked for.
std::vector<fs::path> model_folders(fs::path const& folder) {
  return {folder, folder / "models", CREDO_MODELS_DIR};
}

std::string known_models(std::vector<fs::path> const& folders) {
  std::set<std::string> names;
  // Beside a prior or a scene lie other things than models, so that folder's are not told.
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

bool is_bare_mesh(fs::path const& path) {
  return path.extension() != ".yaml" && path.extension() != ".yml";
}

/// What a model's file tells; of a bare mesh what goes without saying.
ModelFile read_model_file(fs::path const& path) {
  ModelFile file;
  if (is_bare_mesh(path)) {
    file.mesh = path.filename().string();
    file.one_sided = true;
  } else {
    load_config(fields(file), {path}, {});
  }
  if (file.name.empty()) {
    file.name = path.stem().string();
  }
  return file;
}

}  // namespace

fs::path find_model(std::string const& model, fs::path const& asker, std::string const& who) {
  bool const is_path = model.find('/') != std::string::npos || fs::path(model).has_extension();
  if (is_path) {
    fs::path path = asker.parent_path() / model;
    if (!fs::is_regular_file(path)) {
      throw InputError(who + ": model " + path.string() + " is not a file");
    }
    return path;
  }
  if (fs::path path = model_called(model, asker.parent_path()); !path.empty()) {
    return path;
  }
  throw InputError(who + ": no model is called " + model + "; models are " +
                   known_models(model_folders(asker.parent_path())) +
                   ", others are told by their file");
}

fs::path model_called(std::string const& name, fs::path const& folder) {
  for (fs::path const& place : model_folders(folder)) {
    fs::path path = place / (name + ".yaml");
    if (fs::is_regular_file(path)) {
      return path;
    }
  }
  return {};
}

ObjectModel load_model(fs::path const& path, std::vector<std::string>& warnings) {
  ModelFile const file = read_model_file(path);
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

fs::path model_cache(std::string const& cache_dir) {
  if (cache_dir != "auto") {
    return cache_dir;
  }
  // A path that is not absolute must be passed over (XDG Base Directory Specification).
  if (char const* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return fs::path(cache) / "credo";
  }
  if (char const* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return fs::path(home) / ".cache" / "credo";
  }
  return {};
}

void copy_model(fs::path const& file, fs::path const& folder, std::string const& name) {
  ModelFile model = read_model_file(file);
  fs::path const mesh = fs::path(model.mesh).lexically_normal();
  if (mesh.is_absolute() || (!mesh.empty() && *mesh.begin() == "..")) {
    return;
  }
  constexpr auto kReplace = fs::copy_options::overwrite_existing;
  try {
    fs::create_directories((folder / mesh).parent_path());
    if (is_bare_mesh(file)) {
      std::ofstream(folder / (name + ".yaml")) << config_yaml(fields(model));
    } else {
      fs::copy_file(file, folder / (name + ".yaml"), kReplace);
    }
    if (!mesh.empty()) {
      fs::copy_file(file.parent_path() / mesh, folder / mesh, kReplace);
    }
  } catch (fs::filesystem_error const& error) {
    throw InputError(folder.string() + ": cannot be written: " + error.code().message());
  }
}

}  // namespace credo
