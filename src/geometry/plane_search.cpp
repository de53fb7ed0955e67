#include "geometry/plane_search.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace credo {
namespace {

/// A plane in single precision, as the inner loops use it.
struct FloatPlane {
  float normal_x, normal_y, normal_z, offset_m, min_cosine;

  FloatPlane(Plane const& plane, double max_angle_rad)
      : normal_x(static_cast<float>(plane.normal.x())),
        normal_y(static_cast<float>(plane.normal.y())),
        normal_z(static_cast<float>(plane.normal.z())),
        offset_m(static_cast<float>(plane.offset_m)),
        // Above a right angle every |cosine| passes.
        min_cosine(max_angle_rad < 1.5707963 ? static_cast<float>(std::cos(max_angle_rad))
                                             : -1.0F) {}
};

/// 1 where the point belongs to the plane, else 0. A NaN normal fails no comparison, so it passes.
/// All in 32 bits, so that loops vectorise.
inline std::int32_t belongs(FloatPlane const& plane, PlaneSearchPoints const& points,
                            std::size_t i) {
  float const distance = plane.normal_x * points.x[i] + plane.normal_y * points.y[i] +
                         plane.normal_z * points.z[i] - plane.offset_m;
  float const cosine = plane.normal_x * points.normal_x[i] + plane.normal_y * points.normal_y[i] +
                       plane.normal_z * points.normal_z[i];
  std::int32_t const near = std::fabs(distance) <= points.tolerance_m[i] ? 1 : 0;
  std::int32_t const turned = std::fabs(cosine) < plane.min_cosine ? 1 : 0;
  return near & (turned ^ 1);
}

/// At most `count` points, evenly spread over the list.
PlaneSearchPoints spread_subset(PlaneSearchPoints const& points, std::size_t count) {
  PlaneSearchPoints subset;
  std::size_t const kept = std::min(count, points.size());
  subset.reserve(kept);
  for (std::size_t k = 0; k < kept; ++k) {
    std::size_t const i = k * points.size() / kept;
    subset.add({points.x[i], points.y[i], points.z[i]},
               {points.normal_x[i], points.normal_y[i], points.normal_z[i]}, points.tolerance_m[i],
               points.source[i]);
  }
  return subset;
}

std::size_t count_inliers(Plane const& plane, PlaneSearchPoints const& points,
                          double max_angle_rad) {
  FloatPlane const p(plane, max_angle_rad);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    count += belongs(p, points, i);
  }
  return static_cast<std::size_t>(count);
}

Eigen::Vector3d point_at(PlaneSearchPoints const& points, std::size_t i) {
  return {points.x[i], points.y[i], points.z[i]};
}

/// Draws hypotheses. Only the raw bits of the generator are used: distributions differ by library.
class Sampler {
public:
  Sampler(PlaneSearchPoints const& points, PlaneSearchLimits const& limits)
      : points_(points), sampling_(limits.sampling), random_(limits.seed) {}

  std::optional<Plane> draw() {
    std::size_t const a = index();
    if (sampling_ == PlaneSampling::kPointAndNormal) {
      Eigen::Vector3d const normal(points_.normal_x[a], points_.normal_y[a], points_.normal_z[a]);
      if (!normal.allFinite()) {
        return std::nullopt;
      }
      return Plane{normal, normal.dot(point_at(points_, a))};
    }
    Eigen::Vector3d const p = point_at(points_, a);
    Eigen::Vector3d const cross =
        (point_at(points_, index()) - p).cross(point_at(points_, index()) - p);
    double const length = cross.norm();
    if (!(length > 1e-9)) {
      return std::nullopt;
    }
    return Plane{cross / length, (cross / length).dot(p)};
  }

  /// Draws that all succeed with probability w^n for an inlier share w.
  [[nodiscard]] int points_per_draw() const {
    return sampling_ == PlaneSampling::kPointAndNormal ? 1 : 3;
  }

private:
  std::size_t index() { return random_() % points_.size(); }

  PlaneSearchPoints const& points_;
  PlaneSampling sampling_;
  std::mt19937 random_;
};

/// Draws after which a plane with such a share of the points would have been found with the
/// confidence asked for (Fischler and Bolles 1981).
double draws_needed(double share, int points_per_draw, PlaneSearchLimits const& limits) {
  double const hit = std::pow(share, points_per_draw);
  // The logarithms of 0 and 1 are no guide: all draws, or no more.
  if (hit < 1e-12) {
    return limits.max_hypotheses;
  }
  return hit > 1.0 - 1e-9 ? 0.0 : std::log(1.0 - limits.confidence) / std::log(1.0 - hit);
}

}  // namespace

void PlaneSearchPoints::reserve(std::size_t count) {
  for (auto* column : {&x, &y, &z, &normal_x, &normal_y, &normal_z, &tolerance_m}) {
    column->reserve(count);
  }
  source.reserve(count);
}

void PlaneSearchPoints::add(Eigen::Vector3f const& point, Eigen::Vector3f const& normal,
                            float tolerance, std::uint32_t name) {
  x.push_back(point.x());
  y.push_back(point.y());
  z.push_back(point.z());
  normal_x.push_back(normal.x());
  normal_y.push_back(normal.y());
  normal_z.push_back(normal.z());
  tolerance_m.push_back(tolerance);
  source.push_back(name);
}

void PlaneSearchPoints::remove(std::span<std::uint8_t const> removed) {
  auto const compact = [&removed](auto& column) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
      column[kept] = column[i];
      kept += removed[i] == 0 ? 1 : 0;
    }
    column.resize(kept);
  };
  for (auto* column : {&x, &y, &z, &normal_x, &normal_y, &normal_z, &tolerance_m}) {
    compact(*column);
  }
  compact(source);
}

FoundPlane inliers_of(Plane const& plane, PlaneSearchPoints const& points, double max_angle_rad) {
  FloatPlane const p(plane, max_angle_rad);
  FoundPlane found{plane, std::vector<std::uint8_t>(points.size()), 0};
  std::int32_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::int32_t const inlier = belongs(p, points, i);
    found.inliers[i] = static_cast<std::uint8_t>(inlier);
    count += inlier;
  }
  found.inlier_count = static_cast<std::size_t>(count);
  return found;
}

std::optional<Plane> fit_plane(PlaneSearchPoints const& points, std::span<std::uint8_t const> flags,
                               Eigen::Vector3d const& normal_hint) {
  double weight_sum = 0.0;
  std::size_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (flags[i] == 0) {
      continue;
    }
    double const weight =
        1.0 / (static_cast<double>(points.tolerance_m[i]) * points.tolerance_m[i]);
    Eigen::Vector3d const p = point_at(points, i);
    weight_sum += weight;
    ++count;
    sum += weight * p;
    squares += weight * p * p.transpose();
  }
  if (count < 3) {
    return std::nullopt;
  }
  Eigen::Vector3d const mean = sum / weight_sum;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(squares / weight_sum - mean * mean.transpose());
  // Points on one line leave the normal open.
  if (solver.info() != Eigen::Success || !(solver.eigenvalues()(1) > 1e-9)) {
    return std::nullopt;
  }
  Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
  if (normal.dot(normal_hint) < 0) {
    normal = -normal;
  }
  return Plane{normal, normal.dot(mean)};
}

std::optional<FoundPlane> find_largest_plane(PlaneSearchPoints const& points,
                                             PlaneSearchLimits const& limits) {
  if (points.size() < 3) {
    return std::nullopt;
  }
  PlaneSearchPoints const scored =
      spread_subset(points, static_cast<std::size_t>(limits.scoring_points));
  Sampler sampler(points, limits);
  std::optional<Plane> best;
  std::size_t best_count = 0;
  double needed = limits.max_hypotheses;
  for (int k = 0; k < limits.max_hypotheses && k < needed; ++k) {
    std::optional<Plane> const plane = sampler.draw();
    if (!plane) {
      continue;
    }
    std::size_t const count = count_inliers(*plane, scored, limits.max_angle_rad);
    if (!best || count > best_count) {
      best = plane;
      best_count = count;
      needed = draws_needed(static_cast<double>(count) / static_cast<double>(scored.size()),
                            sampler.points_per_draw(), limits);
    }
  }
  if (!best) {
    return std::nullopt;
  }
  // Least squares on the inliers moves the plane, which moves its inliers, until it rests. A few
  // inliers less are no reason to prefer the draw, which is as good as its points; many less are:
  // the fit then follows something else.
  constexpr int kMaxRounds = 8;
  constexpr double kStillTheSame = 0.95;
  FoundPlane found = inliers_of(*best, points, limits.max_angle_rad);
  for (int round = 0; round < kMaxRounds; ++round) {
    std::optional<Plane> const refined = fit_plane(points, found.inliers, found.plane.normal);
    if (!refined) {
      break;
    }
    FoundPlane better = inliers_of(*refined, points, limits.max_angle_rad);
    if (static_cast<double>(better.inlier_count) <
        kStillTheSame * static_cast<double>(found.inlier_count)) {
      break;
    }
    bool const rests = better.inliers == found.inliers;
    found = std::move(better);
    if (rests) {
      break;
    }
  }
  return found;
}

}  // namespace credo
