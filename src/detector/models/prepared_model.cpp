#include "detector/models/prepared_model.hpp"

#include "detector/models/model_cache.hpp"

namespace credo {

PreparedModel prepared(ObjectModel const& model) {
  PreparedModel prepared;
  prepared.model = prepare_model(model);
  prepared.pairs = PairTable(prepared.model);
  return prepared;
}

PreparedModels prepare_models(ObjectModels const& models, std::filesystem::path const& cache) {
  PreparedModels prepared;
  for (auto const& [name, model] : models) {
    prepared.emplace(name, kept_or_prepared(model, cache));
  }
  return prepared;
}

}  // namespace credo
