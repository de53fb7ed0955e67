#include "proposal_detector.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "detector/poses/pose_covariance.hpp"
#include "detector/poses/symmetry_twin.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/search/facet_proposals.hpp"
#include "detector/search/global_search.hpp"
#include "fpfh_proposals.hpp"

namespace credo {
namespace {

/// As BpaDetector has them.
constexpr std::size_t kMaxCandidates = 8;
constexpr float kKnown = 0.5F;

PreparedModels prepared_by_name(std::vector<ObjectModel> const& models) {
  ObjectModels named;
  for (ObjectModel const& model : models) {
    named.emplace(model.name, model);
  }
  return prepare_models(named);
}

Detection detection_of(SearchModel const& model, SearchScene const& scene,
                       PoseCandidate const& candidate) {
  Detection detection;
  detection.type = model.name;
  detection.pose_camera = with_covariance(model, scene, best_twin(model, scene, candidate.pose));
  detection.score = static_cast<double>(candidate.probability);
  detection.visible_fraction = static_cast<double>(candidate.verification.visible_fraction);
  return detection;
}

}  // namespace

ProposalDetector::ProposalDetector(std::vector<ObjectModel> const& models, Proposers proposers,
                                   double min_probability, FpfhSettings const& settings)
    : models_(prepared_by_name(models)),
      proposers_(proposers),
      min_probability_(static_cast<float>(min_probability)),
      settings_(settings) {
  for (auto const& [name, model] : models_) {
    described_[name] = proposers.fpfh ? described(model->model, settings) : DescribedPoints{};
  }
}

std::vector<Proposal> ProposalDetector::proposals_of(std::string const& type,
                                                     SearchScene const& scene,
                                                     DescribedPoints const& of_scene,
                                                     ClaimedPixels const& explained) const {
  PreparedModel const& model = *models_.at(type);
  std::vector<Proposal> proposals;
  if (proposers_.pairs) {
    proposals = propose_by_pairs(model.model, model.pairs, scene, explained);
  }
  if (proposers_.facets) {
    std::ranges::move(propose_by_facets(model.model, scene, explained),
                      std::back_inserter(proposals));
  }
  if (proposers_.fpfh) {
    std::ranges::move(
        propose_by_fpfh(model.model, described_.at(type), scene, of_scene, explained, settings_),
        std::back_inserter(proposals));
  }
  return proposals;
}

std::vector<Detection> ProposalDetector::detect(Frame const& frame,
                                                std::vector<DetectionRequest> const& requests) {
  SearchScene const scene = scene_of(frame);
  DescribedPoints const of_scene =
      proposers_.fpfh ? described(scene, settings_) : DescribedPoints{};
  std::vector<ObjectCandidates> objects;
  for (DetectionRequest const& request : requests) {
    SearchModel const& model = models_.at(request.type)->model;
    objects.push_back({&model, search_among(model, proposals_of(request.type, scene, of_scene, {}),
                                            scene, kMaxCandidates)});
  }
  auto const known = choose_jointly(objects, scene, kKnown);
  if (std::ranges::any_of(known, [](auto const& pose) { return pose.has_value(); })) {
    ClaimedPixels const explained = explained_by(known, scene, kKnown);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!known[i]) {
        auto const proposals = proposals_of(requests[i].type, scene, of_scene, explained);
        objects[i].candidates =
            search_again_among(*objects[i].model, proposals, scene,
                               std::move(objects[i].candidates), explained, kMaxCandidates);
      }
    }
  }
  std::vector<Detection> detections;
  auto const found = choose_jointly(objects, scene, min_probability_);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i]) {
      detections.push_back(detection_of(*objects[i].model, scene, *found[i]));
    }
  }
  return detections;
}

}  // namespace credo
