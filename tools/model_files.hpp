#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/object_model.hpp"

namespace credo {

/// The file of a model that another file names: by its path from that file's folder, or by its
/// name, NAME.yaml beside that file, in a folder models/ there, or in models/ of this project.
/// Throws InputError that begins with `who` and lists the known names.
std::filesystem::path find_model(std::string const& model, std::filesystem::path const& asker,
                                 std::string const& who);

/// The file of the model of that name, looked for as a file in `folder` would have it looked for;
/// empty where there is none.
std::filesystem::path model_called(std::string const& name, std::filesystem::path const& folder);

/// A model with its mesh, named like its file where it names itself not. A file that does not end
/// in .yaml or .yml is a mesh by itself: in metres, one-sided where it is open, without symmetry.
/// What people should know of it is added to `warnings`, a line each. Throws InputError for what is
/// wrong with either file.
ObjectModel load_model(std::filesystem::path const& path, std::vector<std::string>& warnings);

/// Copies a model's file, as NAME.yaml, and the mesh that it names, into a folder, which is made if
/// need be; for a mesh by itself such a file is written. A mesh that is not in the file's own
/// folder or below would not be found there: then nothing is copied. Throws InputError where the
/// folder cannot be written.
void copy_model(std::filesystem::path const& file, std::filesystem::path const& folder,
                std::string const& name);

/// Where models made ready are kept, by `detector.bpa.cache_dir`: `auto` is credo in
/// $XDG_CACHE_HOME, or in ~/.cache where that is not set, or nowhere (empty) where neither is.
std::filesystem::path model_cache(std::string const& cache_dir);

}  // namespace credo
