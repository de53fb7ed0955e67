#include "detector/prepared_model.hpp"

namespace credo {

PreparedModels prepare_models(ObjectModels const& models) {
  PreparedModels prepared;
  for (auto const& [name, model] : models) {
    auto one = std::make_shared<PreparedModel>();
    one->model = prepare_model(model);
    one->pairs = PairTable(one->model);
    prepared.emplace(name, std::move(one));
  }
  return prepared;
}

}  // namespace credo
