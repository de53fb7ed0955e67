#include "detector/poses/open_turn.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "detector/poses/pose_score.hpp"
#include "detector/poses/verification.hpp"

namespace credo {
namespace {

constexpr double kPlain_rad = 0.02;
constexpr double kStep_rad = std::numbers::pi / 18.0;
constexpr int kMostSteps = 18;  // of half a turn
/// What verification finds so much less likely is not followed on.
constexpr float kDrop = 2.0F;
/// Other turns are at least so many steps away from the pose's own and from each other.
constexpr int kApart_steps = 3;
constexpr std::size_t kMostOtherTurns = 6;
constexpr std::size_t kScorePoints = 250;
/// A turn is open where what explains the frame spreads so far.
constexpr double kLeastSpread_rad = 0.15;
/// The line that is told to be the loosest leans against that about which all turns fit.
constexpr double kHingeLean = 0.03;

/// A turn about a line that is fixed in the camera frame.
struct Hinge {
  /// Unit.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();

  [[nodiscard]] CameraPose turned(CameraPose const& pose, double angle_rad) const {
    Eigen::Matrix3f const turn =
        Eigen::AngleAxisd(angle_rad, direction).toRotationMatrix().cast<float>();
    Eigen::Vector3f const on_line = point_m.cast<float>();
    return {turn * pose.rotation, turn * (pose.translation_m - on_line) + on_line};
  }
  /// Of the origin and the rotation, by a turn of any size.
  [[nodiscard]] Vector6d motion_of(CameraPose const& pose, double angle_rad) const {
    Eigen::Vector3d const off_line = pose.translation_m.cast<double>() - point_m;
    Vector6d motion;
    motion << Eigen::AngleAxisd(angle_rad, direction) * off_line - off_line, angle_rad * direction;
    return motion;
  }
};

/// The turn that is told least of, with the shift that goes best with it; none where that is plain.
std::optional<Hinge> loosest(SearchModel const& model, Matrix6d const& information,
                             CameraPose const& pose) {
  Eigen::Matrix3d const of_shifts = information.topLeftCorner<3, 3>();
  Eigen::Matrix3d const across = information.topRightCorner<3, 3>();
  Eigen::Matrix3d const shifts_per_turn = -of_shifts.inverse() * across;
  Eigen::Matrix3d const of_turns =
      information.bottomRightCorner<3, 3>() + across.transpose() * shifts_per_turn;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const solver(of_turns);
  Hinge hinge;
  hinge.direction = solver.eigenvectors().col(0);
  // The line about which the origin moves by that shift, as far as it moves across it.
  Eigen::Vector3d const shift = shifts_per_turn * hinge.direction;
  hinge.point_m = pose.translation_m.cast<double>() + hinge.direction.cross(shift);
  bool const plain = solver.eigenvalues()[0] > 1.0 / (kPlain_rad * kPlain_rad);
  return plain || model.symmetry.axis ? std::nullopt : std::optional(hinge);
}

struct Turned {
  double angle_rad = 0.0;
  Verification verification;
};

/// From the pose to one side.
void follow(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
            Hinge const& hinge, double step_rad, std::vector<Turned>& turns) {
  float best = turns.front().verification.log_odds;
  for (int k = 1; k <= kMostSteps; ++k) {
    double const angle_rad = k * step_rad;
    Verification verification = verified(model, scene, hinge.turned(pose, angle_rad), {});
    best = std::max(best, verification.log_odds);
    if (verification.log_odds < best - kDrop) {
      return;
    }
    turns.push_back({angle_rad, std::move(verification)});
  }
}

/// Of all that was followed, each as likely as it is beside the others; they sum to 1.
std::vector<double> likelihoods_of(std::vector<Turned> const& turns) {
  int most_net_px = 0;
  for (Turned const& turned : turns) {
    most_net_px = std::max(most_net_px, turned.verification.net_px());
  }
  std::vector<double> likelihoods;
  double sum = 0.0;
  for (Turned const& turned : turns) {
    likelihoods.push_back(
        std::exp(static_cast<double>(log_odds_beside(turned.verification, most_net_px))));
    sum += likelihoods.back();
  }
  for (double& likelihood : likelihoods) {
    likelihood /= sum;
  }
  return likelihoods;
}

/// By how much a pose may be off for that the line leans, for each radian turned about it.
Matrix6d leaning(Hinge const& hinge, CameraPose const& pose) {
  Eigen::Vector3d const off_line = pose.translation_m.cast<double>() - hinge.point_m;
  Matrix6d covariance = Matrix6d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    Vector6d lean;
    lean << Eigen::Vector3d::Unit(axis).cross(off_line), Eigen::Vector3d::Unit(axis);
    covariance += kHingeLean * kHingeLean * lean * lean.transpose();
  }
  return covariance;
}

}  // namespace

OpenTurn open_turn(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
                   Matrix6d const& information) {
  OpenTurn open{pose};
  std::optional<Hinge> const hinge = loosest(model, information, pose);
  if (!hinge) {
    return open;
  }
  std::vector<Turned> turns = {{0.0, verified(model, scene, pose, {})}};
  if (turns.front().verification.in_px == 0) {
    return open;
  }
  follow(model, scene, pose, *hinge, kStep_rad, turns);
  follow(model, scene, pose, *hinge, -kStep_rad, turns);
  std::vector<double> const likelihoods = likelihoods_of(turns);
  double mean_rad = 0.0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    mean_rad += likelihoods[i] * turns[i].angle_rad;
  }
  double variance_rad2 = 0.0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    variance_rad2 += likelihoods[i] * std::pow(turns[i].angle_rad - mean_rad, 2);
  }
  if (variance_rad2 < kLeastSpread_rad * kLeastSpread_rad) {
    return open;
  }
  open.pose = hinge->turned(pose, mean_rad);
  open.covariance = variance_rad2 * leaning(*hinge, open.pose);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    Vector6d const motion = hinge->motion_of(open.pose, turns[i].angle_rad - mean_rad);
    open.covariance += likelihoods[i] * motion * motion.transpose();
  }
  return open;
}

std::vector<PoseCandidate> other_turns(SearchModel const& model, SearchScene const& scene,
                                       PoseCandidate const& candidate,
                                       Matrix6d const& information) {
  std::optional<Hinge> const hinge = loosest(model, information, candidate.pose);
  if (!hinge) {
    return {};
  }
  PoseScore const score(model, scene);
  struct Scored {
    int step;
    float score;
  };
  std::vector<Scored> around;
  for (int step = kApart_steps; step <= 2 * kMostSteps - kApart_steps; ++step) {
    around.push_back({step, score(hinge->turned(candidate.pose, step * kStep_rad), kScorePoints)});
  }
  std::ranges::stable_sort(around, std::greater{}, &Scored::score);
  std::vector<int> taken;
  std::vector<PoseCandidate> others;
  for (Scored const& turn : around) {
    bool const apart = std::ranges::none_of(
        taken, [&](int other) { return std::abs(other - turn.step) < kApart_steps; });
    if (apart && taken.size() < kMostOtherTurns) {
      taken.push_back(turn.step);
      CameraPose const pose = hinge->turned(candidate.pose, turn.step * kStep_rad);
      others.push_back(polished(model, scene, {pose, verified(model, scene, pose, {})}));
    }
  }
  return others;
}

}  // namespace credo
