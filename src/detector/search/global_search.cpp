#include "detector/search/global_search.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <random>

#include "detector/poses/open_turn.hpp"
#include "detector/poses/polishing.hpp"
#include "detector/poses/pose_covariance.hpp"
#include "detector/poses/pose_distance.hpp"
#include "detector/poses/pose_refinement.hpp"
#include "detector/poses/pose_score.hpp"
#include "detector/poses/procrustes_refinement.hpp"
#include "detector/search/facet_proposals.hpp"
#include "detector/search/pair_proposals.hpp"

namespace credo {
namespace {

/// A pose on its way through the funnel.
struct Scored {
  CameraPose pose;
  std::uint16_t segment = 0;
  float score = 0.0F;
};

/// One step of the funnel: the best so many poses go on, refined, and are scored again.
struct FunnelStep {
  std::size_t survivors;
  /// Poses nearer to a better one than this, in diameters, are dropped before.
  float apart_diameters;
  RefinementConfig refinement;
  std::size_t score_points;
};

constexpr std::size_t kRoughPoints = 40;
/// So many proposals are looked at more closely.
constexpr std::size_t kRoughSurvivors = 600;
constexpr std::size_t kCoarsePoints = 100;
constexpr std::array<FunnelStep, 3> kFunnel = {
    FunnelStep{120, 0.15F, {4, 120, 0.030F}, 250},
    FunnelStep{40, 0.10F, {6, 250, 0.015F}, 500},
    FunnelStep{16, 0.06F, {5, 800, 0.010F}, 800},
};
/// So many poses of each segment go on, however poor beside others.
constexpr int kOfEachSegment = 2;
constexpr float kCandidatesApart_diameters = 0.10F;
/// So many of the likeliest are polished,
constexpr std::size_t kPolished = 12;
/// and so many of those then turned about what the frame tells least of.
constexpr std::size_t kTurnedAround = 3;
/// Poses whose centres are so near to each other compete for one place.
constexpr float kOnePlace_diameters = 0.3F;
/// Of one model's search, so that it is the same on any thread.
constexpr std::uint64_t kDrawSeed = 1;

void sort_best_first(std::vector<Scored>& poses) {
  std::ranges::stable_sort(poses, std::greater{}, &Scored::score);
}

/// The best, none near to a better one; and the best of each segment.
std::vector<Scored> survivors(std::vector<Scored> poses, PoseDistance const& distance,
                              float apart_m, std::size_t count) {
  sort_best_first(poses);
  std::vector<Scored> kept;
  std::map<std::uint16_t, int> of_segment;
  for (Scored const& pose : poses) {
    bool const wanted = kept.size() < count || of_segment[pose.segment] < kOfEachSegment;
    if (!wanted || pose.score <= PoseScore::kWorst) {
      continue;
    }
    bool const apart = std::ranges::none_of(
        kept, [&](Scored const& better) { return distance(better.pose, pose.pose) < apart_m; });
    if (apart) {
      kept.push_back(pose);
      ++of_segment[pose.segment];
    }
    if (kept.size() >= 2 * count) {
      break;
    }
  }
  return kept;
}

/// Only where that betters it: surfaces draw a pose along themselves, past their silhouettes.
void refine(Scored& pose, SearchModel const& model, SearchScene const& scene,
            PoseScore const& score, FunnelStep const& step) {
  CameraPose const moved = refined(model, scene, pose.pose, step.refinement);
  float const before = score(pose.pose, step.score_points);
  float const after = score(moved, step.score_points);
  pose.score = std::max(before, after);
  if (after > before) {
    pose.pose = moved;
  }
}

/// ICP needs to begin near: what is left of all proposals is drawn towards it before.
void align(std::vector<Scored>& poses, SearchModel const& model, SearchScene const& scene,
           PoseScore const& score, std::mt19937_64& random) {
  for (Scored& pose : poses) {
    ScoredPose const aligned =
        procrustes_refined(model, scene, score, {pose.pose, pose.score}, kCoarsePoints, random);
    pose.pose = aligned.pose;
    pose.score = aligned.score;
  }
}

/// The likeliest so many, none near to a likelier one; likeliest first.
std::vector<PoseCandidate> likeliest(std::vector<PoseCandidate> candidates,
                                     PoseDistance const& distance, float apart_m,
                                     std::size_t count) {
  std::ranges::stable_sort(candidates, std::greater{}, [](PoseCandidate const& candidate) {
    return candidate.verification.log_odds;
  });
  std::vector<PoseCandidate> kept;
  for (PoseCandidate& candidate : candidates) {
    bool const apart = std::ranges::none_of(kept, [&](PoseCandidate const& better) {
      return distance(better.pose, candidate.pose) < apart_m;
    });
    if (apart && kept.size() < count) {
      kept.push_back(std::move(candidate));
    }
  }
  return kept;
}

/// Holds those in one place against each other.
void compare(std::vector<PoseCandidate>& candidates, SearchModel const& model) {
  float const one_place_m = kOnePlace_diameters * model.diameter_m;
  std::vector<int> most_net_px;
  for (PoseCandidate const& candidate : candidates) {
    Eigen::Vector3f const centre = candidate.pose * model.centre_model;
    int most = 0;
    for (PoseCandidate const& other : candidates) {
      if ((other.pose * model.centre_model - centre).norm() < one_place_m) {
        most = std::max(most, other.verification.net_px());
      }
    }
    most_net_px.push_back(most);
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Verification& verification = candidates[i].verification;
    verification.log_odds = log_odds_beside(verification, most_net_px[i]);
  }
}

/// Whether a pose explains what is explained already, for more than half.
bool is_in_place_of_another(PoseCandidate const& candidate, ClaimedPixels const& explained) {
  if (explained.empty()) {
    return false;
  }
  auto const& own = candidate.verification.explained_px;
  auto const shared =
      std::ranges::count_if(own, [&](std::uint32_t pixel) { return explained[pixel] != 0; });
  return 2 * static_cast<std::size_t>(shared) > own.size();
}

/// Each step of the funnel takes a share of what it would.
std::vector<PoseCandidate> search(SearchModel const& model, std::vector<Proposal> const& proposals,
                                  SearchScene const& scene, ClaimedPixels const& explained,
                                  std::size_t share, std::size_t max_candidates) {
  PoseScore const score(model, scene, explained);
  PoseDistance const distance(model);
  std::mt19937_64 random(kDrawSeed);
  std::vector<Scored> poses;
  poses.reserve(proposals.size());
  for (Proposal const& proposal : proposals) {
    poses.push_back({proposal.pose, proposal.segment, score.rough(proposal.pose, kRoughPoints)});
  }
  if (poses.size() > kRoughSurvivors / share) {
    sort_best_first(poses);
    poses.resize(kRoughSurvivors / share);
  }
  for (Scored& pose : poses) {
    pose.score = score(pose.pose, kCoarsePoints);
  }
  for (FunnelStep const& step : kFunnel) {
    poses = survivors(std::move(poses), distance, step.apart_diameters * model.diameter_m,
                      step.survivors / share);
    if (&step == &kFunnel.front()) {
      align(poses, model, scene, score, random);
    }
    for (Scored& pose : poses) {
      refine(pose, model, scene, score, step);
    }
  }
  poses = survivors(std::move(poses), distance, kCandidatesApart_diameters * model.diameter_m,
                    kFunnel.back().survivors / share);
  std::vector<PoseCandidate> candidates;
  candidates.reserve(poses.size());
  for (Scored const& pose : poses) {
    candidates.push_back({pose.pose, verified(model, scene, pose.pose, {})});
  }
  std::erase_if(candidates, [&](PoseCandidate const& candidate) {
    return is_in_place_of_another(candidate, explained);
  });
  float const apart_m = kCandidatesApart_diameters * model.diameter_m;
  candidates = likeliest(std::move(candidates), distance, apart_m, kPolished);
  for (PoseCandidate& candidate : candidates) {
    candidate = polished(model, scene, std::move(candidate));
  }
  candidates = likeliest(std::move(candidates), distance, apart_m, max_candidates);
  std::size_t const found = std::min(kTurnedAround, candidates.size());
  for (std::size_t i = 0; i < found; ++i) {
    std::ranges::move(other_turns(model, scene, candidates[i],
                                  pose_information(model, scene, candidates[i].pose)),
                      std::back_inserter(candidates));
  }
  compare(candidates, model);
  return likeliest(std::move(candidates), distance, apart_m, max_candidates);
}

}  // namespace

std::vector<Proposal> propose_everywhere(SearchModel const& model, PairTable const& pairs,
                                         SearchScene const& scene, ClaimedPixels const& explained) {
  std::vector<Proposal> proposals = propose_by_pairs(model, pairs, scene, explained);
  std::ranges::move(propose_by_facets(model, scene, explained), std::back_inserter(proposals));
  return proposals;
}

std::vector<PoseCandidate> search_among(SearchModel const& model,
                                        std::vector<Proposal> const& proposals,
                                        SearchScene const& scene, std::size_t max_candidates,
                                        ClaimedPixels const& explained) {
  return search(model, proposals, scene, explained, 1, max_candidates);
}

std::vector<PoseCandidate> search_everywhere(SearchModel const& model, PairTable const& pairs,
                                             SearchScene const& scene, std::size_t max_candidates,
                                             ClaimedPixels const& explained) {
  return search_among(model, propose_everywhere(model, pairs, scene, explained), scene,
                      max_candidates, explained);
}

std::vector<PoseCandidate> search_again_among(SearchModel const& model,
                                              std::vector<Proposal> const& proposals,
                                              SearchScene const& scene,
                                              std::vector<PoseCandidate> found_before,
                                              ClaimedPixels const& explained,
                                              std::size_t max_candidates) {
  std::ranges::move(search(model, proposals, scene, explained, 2, max_candidates),
                    std::back_inserter(found_before));
  std::size_t const all = found_before.size();
  return likeliest(std::move(found_before), PoseDistance(model),
                   kCandidatesApart_diameters * model.diameter_m, all);
}

std::vector<PoseCandidate> search_again(SearchModel const& model, PairTable const& pairs,
                                        SearchScene const& scene,
                                        std::vector<PoseCandidate> found_before,
                                        ClaimedPixels const& explained,
                                        std::size_t max_candidates) {
  return search_again_among(model, propose_everywhere(model, pairs, scene, explained), scene,
                            std::move(found_before), explained, max_candidates);
}

}  // namespace credo
