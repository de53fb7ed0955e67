#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/object_model.hpp"
#include "detector/models/prepared_model.hpp"

namespace credo {

/// What a prepared model is kept under: a SHA-256 over the surface, whether it is one-sided, and
/// kPreparationVersion. Name and symmetry change nothing about it.
[[nodiscard]] std::string cache_key(ObjectModel const& model);

/// The model from the file KEY.model in a folder, or else prepared, and then kept there. Both are
/// the same to the bit. A file that is missing, cut, damaged or of another version is made anew. A
/// file appears at once or not at all, so that any number of processes may share a folder. A folder
/// that cannot be made or written is passed over. An empty path: nothing is read or kept. Throws
/// InputError for a model without a surface.
[[nodiscard]] std::shared_ptr<PreparedModel const> kept_or_prepared(
    ObjectModel const& model, std::filesystem::path const& folder);

}  // namespace credo
