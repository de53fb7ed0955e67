#include "methods.hpp"

#include "baselines/ghv_detector.hpp"
#include "baselines/icp_detector.hpp"
#include "baselines/ppf_detector.hpp"
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
      {"icp", made<IcpDetector>},
      {"ghv", made<GhvDetector>},
      {"ppf", made<PpfDetector>},
  };
}

}  // namespace credo
