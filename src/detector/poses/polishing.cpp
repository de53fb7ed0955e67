#include "detector/poses/polishing.hpp"

#include <utility>

#include "detector/poses/pose_refinement.hpp"

namespace credo {
namespace {

/// What is so unlikely is not worth the work.
constexpr float kLeastLogOdds = -8.0F;

}  // namespace

PoseCandidate polished(SearchModel const& model, SearchScene const& scene, PoseCandidate rough) {
  if (rough.verification.log_odds < kLeastLogOdds) {
    return rough;
  }
  CameraPose const moved = refined(model, scene, rough.pose, kFinestRefinement);
  PoseCandidate fine{moved, verified(model, scene, moved, {})};
  return fine.verification.log_odds > rough.verification.log_odds ? std::move(fine)
                                                                  : std::move(rough);
}

}  // namespace credo
