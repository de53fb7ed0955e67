#include "geometry/plane_search.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/grid.hpp"
#include "geometry/plane_search_kernels.hpp"

namespace credo {
namespace {

using plane_search::count_belonging;
using plane_search::mark_belonging;

// All of them are written.
using Positions = std::vector<std::uint32_t, UnsetAllocator<std::uint32_t>>;

/// The positions at which the flag has that value, in their order.
Positions positions_where(std::span<std::uint8_t const> flags, bool value) {
  Positions positions(flags.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    positions[count] = static_cast<std::uint32_t>(i);
    count += (flags[i] != 0) == value ? 1 : 0;
  }
  positions.resize(count);
  return positions;
}

/// The points at those positions, which rise; `to` and `from` may be the same.
void gather(PlaneSearchPoints const& from, std::span<std::uint32_t const> positions,
            PlaneSearchPoints& to) {
  // A column at a time: many loads are then under way at once.
  auto const column = [&](auto const& source, auto& target) {
    target.resize(std::max(target.size(), positions.size()));
    for (std::size_t i = 0; i < positions.size(); ++i) {
      target[i] = source[positions[i]];
    }
    target.resize(positions.size());
  };
  column(from.x, to.x);
  column(from.y, to.y);
  column(from.z, to.z);
  column(from.normal_x, to.normal_x);
  column(from.normal_y, to.normal_y);
  column(from.normal_z, to.normal_z);
  column(from.tolerance_m, to.tolerance_m);
  column(from.source, to.source);
}

/// At most `count` points, evenly spread over the list.
PlaneSearchPoints spread_subset(PlaneSearchPoints const& points, std::size_t count) {
  Positions positions(std::min(count, points.size()));
  for (std::size_t k = 0; k < positions.size(); ++k) {
    positions[k] = static_cast<std::uint32_t>(k * points.size() / positions.size());
  }
  return points.at(positions);
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
  /// One number large: a search draws a few dozen times, and each segment has its own.
  std::minstd_rand random_;
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

PlaneSearchPoints PlaneSearchPoints::at(std::span<std::uint32_t const> positions) const {
  PlaneSearchPoints points;
  gather(*this, positions, points);
  return points;
}

void PlaneSearchPoints::remove(std::span<std::uint8_t const> removed) {
  gather(*this, positions_where(removed, false), *this);
}

FoundPlane inliers_of(Plane const& plane, PlaneSearchPoints const& points, double max_angle_rad) {
  FoundPlane found{plane, std::vector<std::uint8_t>(points.size()), 0};
  found.inlier_count = mark_belonging({plane, max_angle_rad}, points, found.inliers);
  return found;
}

std::optional<Plane> fit_plane(PlaneSearchPoints const& points, std::span<std::uint8_t const> flags,
                               Eigen::Vector3d const& normal_hint) {
  double weight_sum = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double xx = 0.0;
  double yx = 0.0;
  double yy = 0.0;
  double zx = 0.0;
  double zy = 0.0;
  double zz = 0.0;
  Positions const flagged = positions_where(flags, true);
  for (std::size_t const i : flagged) {
    Eigen::Vector3d const p = point_at(points, i);
    double const tolerance_m = points.tolerance_m[i];
    double const weight = 1.0 / (tolerance_m * tolerance_m);
    Eigen::Vector3d const weighted = weight * p;
    weight_sum += weight;
    sum += weighted;
    xx += weighted.x() * p.x();
    yx += weighted.y() * p.x();
    yy += weighted.y() * p.y();
    zx += weighted.z() * p.x();
    zy += weighted.z() * p.y();
    zz += weighted.z() * p.z();
  }
  if (flagged.size() < 3) {
    return std::nullopt;
  }
  Eigen::Vector3d const mean = sum / weight_sum;
  Eigen::Matrix3d squares;
  squares << xx, yx, zx, yx, yy, zy, zx, zy, zz;
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

FoundPlane refined(FoundPlane found, PlaneSearchPoints const& points, double max_angle_rad) {
  // Least squares on the inliers moves the plane, which moves its inliers, until it rests. A few
  // inliers less are no reason to prefer the draw, which is as good as its points; many less are:
  // the fit then follows something else.
  constexpr int kMaxRounds = 8;
  constexpr double kStillTheSame = 0.95;
  for (int round = 0; round < kMaxRounds; ++round) {
    std::optional<Plane> const fit = fit_plane(points, found.inliers, found.plane.normal);
    if (!fit) {
      break;
    }
    FoundPlane better = inliers_of(*fit, points, max_angle_rad);
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

std::optional<FoundPlane> find_largest_plane(PlaneSearchPoints const& points,
                                             PlaneSearchLimits const& limits) {
  if (points.size() < 3) {
    return std::nullopt;
  }
  auto const most_scored = static_cast<std::size_t>(limits.scoring_points);
  PlaneSearchPoints some;
  if (points.size() > most_scored) {
    some = spread_subset(points, most_scored);
  }
  PlaneSearchPoints const& scored = points.size() > most_scored ? some : points;
  Sampler sampler(points, limits);
  std::optional<Plane> best;
  std::size_t best_count = 0;
  double needed = limits.max_hypotheses;
  for (int k = 0; k < limits.max_hypotheses && k < needed; ++k) {
    std::optional<Plane> const plane = sampler.draw();
    if (!plane) {
      continue;
    }
    std::size_t const count = count_belonging({*plane, limits.max_angle_rad}, scored, best_count);
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
  return refined(inliers_of(*best, points, limits.max_angle_rad), points, limits.max_angle_rad);
}

}  // namespace credo
