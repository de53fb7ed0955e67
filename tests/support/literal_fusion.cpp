#include "support/literal_fusion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace credo::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Points = Eigen::Matrix3Xd;

Points points_of(StuffCluster const& cluster) {
  Points points(3, static_cast<Eigen::Index>(cluster.points_world.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points.col(i) = cluster.points_world[static_cast<std::size_t>(i)].cast<double>();
  }
  return points;
}

/// The target's points nearest to each point.
Points nearest(Points const& points, Points const& target) {
  Points found(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Index at = 0;
    (target.colwise() - points.col(i)).colwise().squaredNorm().minCoeff(&at);
    found.col(i) = target.col(at);
  }
  return found;
}

/// Infinite where a limit is exceeded.
double icp_score(StuffCluster const& source_cluster, StuffCluster const& target_cluster,
                 StuffFusionConfig const& config) {
  Points const source = points_of(source_cluster);
  Points const target = points_of(target_cluster);
  Points moved = source;
  for (int iteration = 0; iteration < config.max_icp_iterations; ++iteration) {
    Eigen::Matrix4d const motion = Eigen::umeyama(source, nearest(moved, target), false);
    moved =
        (motion.topLeftCorner<3, 3>() * source).colwise() + motion.topRightCorner<3, 1>().col(0);
  }
  double const sum_m2 = (nearest(moved, target) - moved).squaredNorm();
  double const mean_m2 = sum_m2 / static_cast<double>(source.cols());
  double const displacement_m = std::sqrt((moved - source).colwise().squaredNorm().maxCoeff());
  bool const refused =
      (config.max_rms_m > 0.0 &&
       std::sqrt(mean_m2) > config.max_rms_m + 0.5 * config.point_spacing_m) ||
      (config.max_displacement_m > 0.0 && displacement_m > config.max_displacement_m);
  if (refused) {
    return kInfinity;
  }
  return sum_m2;
}

bool candidates(StuffCluster const& a, StuffCluster const& b, double margin_m) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    float const gap_m = std::max(a.bounds_world.min()[axis], b.bounds_world.min()[axis]) -
                        std::min(a.bounds_world.max()[axis], b.bounds_world.max()[axis]);
    if (static_cast<double>(gap_m) > margin_m) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::optional<std::size_t>> literal_matches(std::vector<StuffCluster> const& known,
                                                        std::vector<StuffCluster> const& seen,
                                                        StuffFusionConfig const& config) {
  Eigen::MatrixXd to_known = Eigen::MatrixXd::Constant(
      static_cast<Eigen::Index>(known.size()), static_cast<Eigen::Index>(seen.size()), kInfinity);
  Eigen::MatrixXd to_seen = to_known;
  for (std::size_t i = 0; i < known.size(); ++i) {
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (!candidates(known[i], seen[j], config.box_margin_m)) {
        continue;
      }
      double const a = icp_score(seen[j], known[i], config);
      double const b = icp_score(known[i], seen[j], config);
      if (std::isfinite(a) && std::isfinite(b)) {
        to_known(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = a;
        to_seen(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = b;
      }
    }
  }
  std::vector<std::optional<std::size_t>> matches(known.size());
  for (std::size_t i = 0; i < known.size() && !seen.empty(); ++i) {
    Eigen::Index best_seen = 0;
    double const score = to_known.row(static_cast<Eigen::Index>(i)).minCoeff(&best_seen);
    Eigen::Index best_known = 0;
    to_seen.col(best_seen).minCoeff(&best_known);
    if (std::isfinite(score) && best_known == static_cast<Eigen::Index>(i)) {
      matches[i] = static_cast<std::size_t>(best_seen);
    }
  }
  return matches;
}

}  // namespace credo::test
