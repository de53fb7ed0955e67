#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "core/object_model.hpp"
#include "detector/models/pair_table.hpp"
#include "detector/models/search_model.hpp"

namespace credo {

/// All that the search knows of a model.
struct PreparedModel {
  SearchModel model;
  PairTable pairs;
};

/// By the name of their model.
using PreparedModels = std::map<std::string, std::shared_ptr<PreparedModel const>>;

/// Takes about 0.3 s. Throws InputError for a model without a surface.
[[nodiscard]] PreparedModel prepared(ObjectModel const& model);

/// All of them, as far as they are kept in a folder from there (model_cache.hpp); an empty path for
/// no folder.
[[nodiscard]] PreparedModels prepare_models(ObjectModels const& models,
                                            std::filesystem::path const& cache = {});

}  // namespace credo
