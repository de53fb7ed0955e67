#include "methods.hpp"

#include "truth_detector.hpp"

namespace credo {
namespace {

/// A method that is a class made of the models.
template <typename Kind>
std::unique_ptr<Detector> made(std::vector<ObjectModel> const& models) {
  return std::make_unique<Kind>(models);
}

}  // namespace

std::vector<Method> all_methods(std::vector<TableView> const& views) {
  return {
      {"truth", [&views](auto const&) { return std::make_unique<TruthDetector>(views); }},
  };
}

}  // namespace credo
