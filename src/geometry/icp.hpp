#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>

#include "core/se3.hpp"

namespace credo {

struct IcpConfig {
  int max_iterations = 20;
  /// Converged when an iteration moves no source point by more than this, or when it leaves every
  /// point with the neighbour it had: a further iteration would change nothing.
  double min_step_m = 1e-3;
  /// What an alignment may be at most, to be one; both infinite by default.
  double max_rms_m = std::numeric_limits<double>::infinity();
  /// How far any source point may have been moved.
  double max_displacement_m = std::numeric_limits<double>::infinity();
};

struct IcpAlignment {
  /// Takes the source's points to the target; both sets are told in the same frame.
  Se3 T_target_source;
  /// Squared distances from each moved source point to its nearest target point.
  double sum_squared_m2 = 0.0;
  double rms_m = 0.0;
  int iterations = 0;
};

/// Point-to-point ICP (Besl and McKay 1992) from the identity: each source point is paired with the
/// target point nearest to it (ties: the first), and the least-squares motion of the pairs (Horn
/// 1987) is applied, until converged. For sets of up to a few hundred points: the neighbours are
/// searched exhaustively, which is exact, vectorises, and at this size beats a tree.
///
/// Points that are not finite are left out. None where either set is then empty, and where the
/// alignment exceeds the config's limits; the cheap proof of that, before any iteration, is that
/// points which may move by d at most cannot come nearer to the target than their distance less d.
/// Where the pairs leave a rotation undetermined (one point, points on a line), it is the least
/// one.
[[nodiscard]] std::optional<IcpAlignment> align_icp(std::span<Eigen::Vector3f const> source,
                                                    std::span<Eigen::Vector3f const> target,
                                                    IcpConfig const& config);

}  // namespace credo
