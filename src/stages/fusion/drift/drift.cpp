#include "stages/fusion/drift/drift.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace credo {
namespace {

/// Steps, and how many sigmas an offset may have in each: what a jump of the camera moved far is
/// found again first, and what is not the surface at all is left out last.
constexpr std::array kMostSigmas{8.0, 4.0, 3.0, 3.0};
/// From which step on things are doubted that by themselves stand elsewhere; before it all do.
constexpr std::size_t kFirstDoubt = 2;
/// Then so far away halves, or more, what a thing counts.
constexpr double kElsewhere_m = 0.005;

/// Blocks of one surface that count as if they erred independently.
constexpr double kBlocksOfPlane = 150.0;
constexpr double kShareOfItem = 0.5;

// What a frame must show to be corrected.
constexpr std::size_t kLeastOfFloor = 60;
constexpr std::size_t kLeastOfWall = 40;
constexpr std::size_t kLeastOfItem = 10;
constexpr int kLeastWalls = 2;
constexpr int kLeastItems = 3;

bool is_enough(std::vector<SurfaceOffsets> const& surfaces) {
  int floors = 0;
  int walls = 0;
  int items = 0;
  for (SurfaceOffsets const& surface : surfaces) {
    std::size_t const blocks = surface.offsets.size();
    switch (surface.kind) {
      case SurfaceKind::kGround:
        floors += blocks >= kLeastOfFloor ? 1 : 0;
        break;
      case SurfaceKind::kWall:
        walls += blocks >= kLeastOfWall ? 1 : 0;
        break;
      case SurfaceKind::kThing:
        items += blocks >= kLeastOfItem ? 1 : 0;
        break;
    }
  }
  return floors > 0 || walls >= kLeastWalls || items >= kLeastItems;
}

double tukey_weight(double sigmas, double most_sigmas) {
  double const inside = 1.0 - sigmas * sigmas / (most_sigmas * most_sigmas);
  return inside > 0.0 ? inside * inside : 0.0;
}

/// How much each block of a surface counts.
double share_of_block(SurfaceOffsets const& surface) {
  return surface.kind == SurfaceKind::kThing
             ? kShareOfItem
             : std::min(1.0, kBlocksOfPlane / static_cast<double>(surface.offsets.size()));
}

/// Where a thing stands by itself, from where it is believed to; less, where the frame tells less.
Eigen::Vector3d shift_m(SurfaceOffsets const& surface) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / (kElsewhere_m * kElsewhere_m);
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (BlockOffset const& block : surface.offsets) {
    double const weight = 1.0 / (block.sigma_m * block.sigma_m);
    information.noalias() += (weight * block.normal_world) * block.normal_world.transpose();
    gradient += weight * block.distance_m * block.normal_world;
  }
  return information.llt().solve(gradient);
}

/// Things that were moved, or that move, do not take the camera with them.
void doubt_what_moved(std::vector<SurfaceOffsets>& surfaces) {
  for (SurfaceOffsets& surface : surfaces) {
    if (surface.kind == SurfaceKind::kThing) {
      double const share =
          1.0 / (1.0 + shift_m(surface).squaredNorm() / (kElsewhere_m * kElsewhere_m));
      surface.trust = share * share;
    }
  }
}

/// Where the camera stands; none where the frame does not say.
std::optional<Se3> found_pose(DriftView const& view, Se3 const& T_world_expected,
                              DriftConfig const& config) {
  Vector6d prior;
  prior.head<3>().setConstant(1.0 / (config.step_m * config.step_m));
  prior.tail<3>().setConstant(1.0 / (config.step_rad * config.step_rad));
  Vector6d error = Vector6d::Zero();
  for (std::size_t step = 0; step < kMostSigmas.size(); ++step) {
    double const most_sigmas = kMostSigmas[step];
    Se3 const T_world_camera = boxplus(T_world_expected, error);
    std::vector<SurfaceOffsets> surfaces = view.offsets(T_world_camera, most_sigmas);
    if (!is_enough(surfaces)) {
      return std::nullopt;
    }
    if (step >= kFirstDoubt) {
      doubt_what_moved(surfaces);
    }
    NormalEquations equations =
        normal_equations(surfaces, T_world_camera.translation(), most_sigmas);
    equations.information.diagonal() += prior;
    equations.gradient += prior.cwiseProduct(error);
    error -= equations.information.ldlt().solve(equations.gradient);
    if (!error.allFinite()) {
      return std::nullopt;
    }
  }
  return boxplus(T_world_expected, error);
}

Eigen::Vector3d shortened(Eigen::Vector3d const& v, double most) {
  double const length = v.norm();
  return length > most ? Eigen::Vector3d(v * (most / length)) : v;
}

/// No farther from what is told than the config allows.
Se3 bounded(Se3 const& T_world_camera, Se3 const& T_told_camera, DriftConfig const& config) {
  Vector6d error = boxminus(T_world_camera, T_told_camera);
  error.head<3>() = shortened(error.head<3>(), config.max_m);
  error.tail<3>() = shortened(error.tail<3>(), config.max_rad);
  return boxplus(T_told_camera, error);
}

}  // namespace

NormalEquations normal_equations(std::vector<SurfaceOffsets> const& surfaces,
                                 Eigen::Vector3d const& camera_world, double most_sigmas) {
  NormalEquations equations;
  for (SurfaceOffsets const& surface : surfaces) {
    double const share = surface.trust * share_of_block(surface);
    for (BlockOffset const& block : surface.offsets) {
      double const weight = share * tukey_weight(block.distance_m / block.sigma_m, most_sigmas) /
                            (block.sigma_m * block.sigma_m);
      Vector6d along;
      along << block.normal_world, (block.p_world - camera_world).cross(block.normal_world);
      equations.information.noalias() += (weight * along) * along.transpose();
      equations.gradient += weight * block.distance_m * along;
    }
  }
  return equations;
}

Se3 tracked_drift(BeliefState const& belief, Segmentation const& segmentation,
                  DriftConfig const& config) {
  Se3 const T_told_camera = segmentation.T_world_told.inverse() * segmentation.T_world_camera;
  Se3 const T_world_expected = belief.T_world_told * T_told_camera;
  DriftView const view(belief, segmentation, T_world_expected);
  std::optional<Se3> const T_world_camera = found_pose(view, T_world_expected, config);
  return T_world_camera ? bounded(*T_world_camera, T_told_camera, config) * T_told_camera.inverse()
                        : belief.T_world_told;
}

}  // namespace credo
