#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/object_model.hpp"
#include "detector/pair_table.hpp"
#include "detector/search_model.hpp"

namespace credo {

/// All that the search knows of a model.
struct PreparedModel {
  SearchModel model;
  PairTable pairs;
};

/// By the name of their model.
using PreparedModels = std::map<std::string, std::shared_ptr<PreparedModel const>>;

/// Takes about 0.3 s for a model. Throws InputError for one without a surface.
[[nodiscard]] PreparedModels prepare_models(ObjectModels const& models);

}  // namespace credo
