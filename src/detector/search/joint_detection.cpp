#include "detector/search/joint_detection.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "detector/search/joint_choice.hpp"

namespace credo {
namespace {

/// Where a pose comes from: an object's candidate.
struct Place {
  std::size_t object = 0;
  std::size_t candidate = 0;
};

/// A pose counts for something only where it is likelier than this.
constexpr float kLeastLogOdds = 0.05F;

double log_odds_of(float probability, float min_probability) {
  auto const logit = [](float p) {
    float const bounded = std::clamp(p, 1e-6F, 1.0F - 1e-6F);
    return std::log(bounded / (1.0F - bounded));
  };
  return static_cast<double>(std::max(logit(probability) - logit(min_probability), kLeastLogOdds));
}

}  // namespace

std::vector<std::optional<PoseCandidate>> choose_jointly(
    std::vector<ObjectCandidates> const& objects, SearchScene const& scene, float min_probability) {
  std::vector<std::vector<Lead>> const leads = leads_of(objects, scene.pixels.width());
  std::vector<Explanation> explanations;
  std::vector<Place> places;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    for (std::size_t c = 0; c < objects[o].candidates.size(); ++c) {
      Verification const& verification = objects[o].candidates[c].verification;
      float const probability = probability_among(verification.log_odds, leads[o][c]);
      if (probability >= min_probability && !verification.explained_px.empty()) {
        explanations.push_back(
            {o, log_odds_of(probability, min_probability), verification.explained_px});
        places.push_back({o, c});
      }
    }
  }
  std::vector<std::size_t> chosen = best_choice(explanations);
  std::ranges::stable_sort(chosen, std::greater{},
                           [&](std::size_t i) { return explanations[i].log_odds; });
  std::vector<std::optional<PoseCandidate>> found(objects.size());
  ClaimedPixels claimed(scene.pixels.width(), scene.pixels.height(), 0);
  for (std::size_t const i : chosen) {
    auto const& [object, position] = places[i];
    PoseCandidate candidate = objects[object].candidates[position];
    float const alone = candidate.verification.log_odds;
    candidate.verification = verified(*objects[object].model, scene, candidate.pose, claimed);
    candidate.verification.log_odds = std::min(alone, candidate.verification.log_odds);
    candidate.probability =
        probability_among(candidate.verification.log_odds, leads[object][position]);
    if (candidate.probability < min_probability) {
      continue;
    }
    for (std::uint32_t const pixel : candidate.verification.explained_px) {
      claimed[pixel] = 1;
    }
    found[object] = std::move(candidate);
  }
  return found;
}

ClaimedPixels explained_by(std::vector<std::optional<PoseCandidate>> const& found,
                           SearchScene const& scene, float least_probability) {
  ClaimedPixels explained(scene.pixels.width(), scene.pixels.height(), 0);
  for (std::optional<PoseCandidate> const& pose : found) {
    if (pose && pose->probability >= least_probability) {
      for (std::uint32_t const pixel : pose->verification.explained_px) {
        explained[pixel] = 1;
      }
    }
  }
  return explained;
}

}  // namespace credo
