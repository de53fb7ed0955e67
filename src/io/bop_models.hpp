#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/object_model.hpp"

namespace credo {

/// The models of a folder as the BOP benchmark has them: `models_info.json` and a mesh
/// `obj_NNNNNN.ply` in millimetres for each of its entries. Entry 5 is called PREFIX_5. A discrete
/// symmetry's shift is left out: it must be under 2 mm, since a Symmetry turns about the origin.
/// In order of their numbers. Throws InputError for a file that is missing or not as it must be.
[[nodiscard]] std::vector<ObjectModel> read_bop_models(std::filesystem::path const& folder,
                                                       std::string const& prefix);

}  // namespace credo
