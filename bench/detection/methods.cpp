#include "methods.hpp"

#include <utility>

#include "baselines/ghv_detector.hpp"
#include "baselines/icp_detector.hpp"
#include "baselines/ppf_detector.hpp"
#include "core/detector_config.hpp"
#include "detector/bpa_detector.hpp"
#include "proposals/proposal_detector.hpp"
#include "truth_detector.hpp"

namespace credo {
namespace {

/// A method that is a class made of the models.
template <typename Kind>
std::unique_ptr<Detector> made(std::vector<ObjectModel> const& models) {
  return std::make_unique<Kind>(models);
}

/// The search of `bpa` after other proposals.
Method proposed_by(std::string name, Proposers proposers, double told_from) {
  return {std::move(name), [proposers, told_from](std::vector<ObjectModel> const& models) {
            return std::make_unique<ProposalDetector>(models, proposers, told_from);
          }};
}

}  // namespace

std::vector<Method> all_methods(std::vector<TableView> const& views, double told_from) {
  return {
      {"bpa",
       [told_from](std::vector<ObjectModel> const& models) -> std::unique_ptr<Detector> {
         ObjectModels named;
         for (ObjectModel const& model : models) {
           named.emplace(model.name, model);
         }
         BpaConfig config;
         config.search = ObjectSearch::kGlobal;
         config.min_probability = told_from;
         return std::make_unique<BpaDetector>(named, config);
       }},
      {"truth", [&views](auto const&) { return std::make_unique<TruthDetector>(views); }},
      {"icp", made<IcpDetector>},
      {"ghv", made<GhvDetector>},
      {"ppf", made<PpfDetector>},
      proposed_by("pairs", {.pairs = true}, told_from),
      proposed_by("fpfh", {.fpfh = true}, told_from),
      proposed_by("fpfh-facets", {.facets = true, .fpfh = true}, told_from),
      proposed_by("bpa-fpfh", {.pairs = true, .facets = true, .fpfh = true}, told_from),
  };
}

}  // namespace credo
