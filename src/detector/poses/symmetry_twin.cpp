#include "detector/poses/symmetry_twin.hpp"

#include <vector>

#include "detector/poses/pose_evidence.hpp"
#include "detector/poses/pose_refinement.hpp"

namespace credo {
namespace {

constexpr double kNearer = 0.9;

std::vector<CameraPose> twins_of(Symmetry const& symmetry, CameraPose const& pose) {
  std::vector<CameraPose> twins;
  for (Eigen::Quaterniond const& rotation : symmetry.rotations) {
    twins.push_back(
        {pose.rotation * rotation.toRotationMatrix().cast<float>(), pose.translation_m});
  }
  if (symmetry.axis && symmetry.axis->both_ways) {
    CameraPose const turn = camera_pose(end_for_end(*symmetry.axis));
    twins.push_back({pose.rotation * turn.rotation, pose * turn.translation_m});
  }
  return twins;
}

}  // namespace

CameraPose best_twin(SearchModel const& model, SearchScene const& scene, CameraPose const& pose) {
  std::vector<CameraPose> const twins = twins_of(model.symmetry, pose);
  if (twins.empty()) {
    return pose;
  }
  PoseEvidence const told = evidence_of(model, scene, pose);
  CameraPose best = pose;
  double least = kNearer * told.mean_squared_residual;
  for (CameraPose const& twin : twins) {
    CameraPose const moved = refined(model, scene, twin, kFinestRefinement);
    PoseEvidence const evidence = evidence_of(model, scene, moved);
    // What lies on the scene with fewer points may lie nearer for that.
    bool const lies_as_well = 10 * evidence.points >= 9 * told.points;
    if (evidence.points > 0 && lies_as_well && evidence.mean_squared_residual < least) {
      least = evidence.mean_squared_residual;
      best = moved;
    }
  }
  return best;
}

}  // namespace credo
