#include "geometry/icp.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// Compiled once per instruction set below, and chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/icp.cpp"  // NOLINT(*-macro-usage): Highway includes it
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// For each source point, the first of the target points nearest to it and the squared distance.
/// Lanes are source points: no sum or minimum runs across lanes, so that their number changes no
/// bit. `source_count` is a multiple of the padding; the target is not empty.
void nearest_points(float const* const source[3], std::size_t source_count,
                    float const* const target[3], std::size_t target_count, std::int32_t* nearest,
                    float* squared_m2) {
  hn::CappedTag<float, 16> const d;
  hn::RebindToSigned<decltype(d)> const di;
  for (std::size_t i = 0; i < source_count; i += hn::Lanes(d)) {
    auto const x = hn::LoadU(d, source[0] + i);
    auto const y = hn::LoadU(d, source[1] + i);
    auto const z = hn::LoadU(d, source[2] + i);
    auto best = hn::Set(d, std::numeric_limits<float>::infinity());
    auto best_at = hn::Zero(di);
    for (std::size_t j = 0; j < target_count; ++j) {
      auto const dx = hn::Sub(x, hn::Set(d, target[0][j]));
      auto const dy = hn::Sub(y, hn::Set(d, target[1][j]));
      auto const dz = hn::Sub(z, hn::Set(d, target[2][j]));
      auto const squared = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      auto const nearer = hn::Lt(squared, best);
      best = hn::IfThenElse(nearer, squared, best);
      best_at = hn::IfThenElse(hn::RebindMask(di, nearer),
                               hn::Set(di, static_cast<std::int32_t>(j)), best_at);
    }
    hn::StoreU(best_at, di, nearest + i);
    hn::StoreU(best, d, squared_m2 + i);
  }
}

}  // namespace credo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo {

HWY_EXPORT(nearest_points);

namespace {

/// The widest vector of nearest_points.
constexpr std::size_t kPadding = 16;

/// Points as three arrays; the last point is repeated up to the padding.
struct PaddedPoints {
  std::array<std::vector<float>, 3> axis;
  std::size_t count = 0;

  explicit PaddedPoints(std::span<Eigen::Vector3f const> points) {
    std::size_t const padded = (points.size() + kPadding - 1) / kPadding * kPadding;
    for (auto& values : axis) {
      values.reserve(padded);
    }
    for (Eigen::Vector3f const& p : points) {
      if (p.allFinite()) {
        push(p);
        ++count;
      }
    }
    while (count > 0 && axis[0].size() % kPadding != 0) {
      push(at(count - 1).cast<float>());
    }
  }

  [[nodiscard]] Eigen::Vector3d at(std::size_t i) const {
    return Eigen::Vector3f(axis[0][i], axis[1][i], axis[2][i]).cast<double>();
  }
  void set(std::size_t i, Eigen::Vector3f const& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      axis[k][i] = p[static_cast<Eigen::Index>(k)];
    }
  }
  [[nodiscard]] std::array<float const*, 3> data() const {
    return {axis[0].data(), axis[1].data(), axis[2].data()};
  }

private:
  void push(Eigen::Vector3f const& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      axis[k].push_back(p[static_cast<Eigen::Index>(k)]);
    }
  }
};

struct Neighbours {
  std::vector<std::int32_t> nearest;
  std::vector<float> squared_m2;

  explicit Neighbours(std::size_t padded_count) : nearest(padded_count), squared_m2(padded_count) {}

  void find(PaddedPoints const& moved, PaddedPoints const& target) {
    HWY_DYNAMIC_DISPATCH(nearest_points)
    (moved.data().data(), moved.axis[0].size(), target.data().data(), target.count, nearest.data(),
     squared_m2.data());
  }
};

/// The motion that takes the source points nearest to their neighbours in the target: Horn's
/// quaternion, the eigenvector of the largest eigenvalue of his matrix N.
Se3 least_squares_motion(PaddedPoints const& source, PaddedPoints const& target,
                         std::vector<std::int32_t> const& nearest) {
  Eigen::Vector3d source_sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_sum = Eigen::Vector3d::Zero();
  auto const paired = [&](std::size_t i) {
    return target.at(static_cast<std::size_t>(nearest[i]));
  };
  for (std::size_t i = 0; i < source.count; ++i) {
    source_sum += source.at(i);
    target_sum += paired(i);
  }
  auto const count = static_cast<double>(source.count);
  Eigen::Vector3d const source_mean = source_sum / count;
  Eigen::Vector3d const target_mean = target_sum / count;
  // Sums of products, s(i, j) over a_i b_j. Scalars: with Eigen's vectors of three g++ stores
  // halves and loads wholes, and the processor waits for each.
  std::array<double, 9> sums{};
  double source_spread_m2 = 0.0;
  double target_spread_m2 = 0.0;
  for (std::size_t i = 0; i < source.count; ++i) {
    Eigen::Vector3d const a = source.at(i) - source_mean;
    Eigen::Vector3d const b = paired(i) - target_mean;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] += a[static_cast<Eigen::Index>(k / 3)] * b[static_cast<Eigen::Index>(k % 3)];
    }
    source_spread_m2 += a.squaredNorm();
    target_spread_m2 += b.squaredNorm();
  }
  Eigen::Matrix3d const s =
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor> const>(sums.data());
  // No entry of s is larger (Cauchy and Schwarz).
  double const spread_m2 = std::sqrt(source_spread_m2 * target_spread_m2);
  if (!(spread_m2 > 0.0)) {
    return {Eigen::Quaterniond::Identity(), target_mean - source_mean};
  }
  Eigen::Vector3d const twist(s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0));
  Eigen::Matrix4d n;
  n(0, 0) = s.trace();
  n.block<1, 3>(0, 1) = twist.transpose();
  n.block<3, 1>(1, 0) = twist;
  n.block<3, 3>(1, 1) = s + s.transpose() - s.trace() * Eigen::Matrix3d::Identity();
  // Among rotations that fit alike this prefers the least; it bends a determined one by 1e-9 rad.
  n(0, 0) += 1e-9 * spread_m2;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> const solver(n);
  Eigen::Vector4d const q = solver.eigenvectors().col(3);
  Eigen::Quaterniond const rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  return {rotation, target_mean - rotation * source_mean};
}

/// Whether points that move by at most `max_displacement_m` could still come to lie within
/// `max_rms_m` of the target. The small allowance is for rounding.
bool within_reach(Neighbours const& unmoved, std::size_t count, IcpConfig const& config) {
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    double const distance_m = std::sqrt(static_cast<double>(unmoved.squared_m2[i]));
    double const remaining_m = std::max(0.0, distance_m - config.max_displacement_m);
    sum_m2 += remaining_m * remaining_m;
  }
  return std::sqrt(sum_m2 / static_cast<double>(count)) <= config.max_rms_m * 1.001 + 1e-4;
}

/// Puts `moved` where the motion takes the source and gives the longest way from where it was.
double move_points(PaddedPoints const& source, Se3 const& motion, PaddedPoints& moved) {
  Eigen::Matrix3d const rotation = motion.rotation().toRotationMatrix();
  double longest_m2 = 0.0;
  for (std::size_t i = 0; i < source.axis[0].size(); ++i) {
    Eigen::Vector3f const p = (rotation * source.at(i) + motion.translation()).cast<float>();
    longest_m2 = std::max(longest_m2, (p.cast<double>() - moved.at(i)).squaredNorm());
    moved.set(i, p);
  }
  return std::sqrt(longest_m2);
}

double longest_way_m(PaddedPoints const& from, PaddedPoints const& to) {
  double longest_m2 = 0.0;
  for (std::size_t i = 0; i < from.count; ++i) {
    longest_m2 = std::max(longest_m2, (from.at(i) - to.at(i)).squaredNorm());
  }
  return std::sqrt(longest_m2);
}

double sum_of(std::vector<float> const& squared_m2, std::size_t count) {
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    sum_m2 += static_cast<double>(squared_m2[i]);
  }
  return sum_m2;
}

}  // namespace

std::optional<IcpAlignment> align_icp(std::span<Eigen::Vector3f const> source,
                                      std::span<Eigen::Vector3f const> target,
                                      IcpConfig const& config) {
  PaddedPoints const source_points(source);
  PaddedPoints const target_points(target);
  if (source_points.count == 0 || target_points.count == 0) {
    return std::nullopt;
  }
  PaddedPoints moved = source_points;
  Neighbours neighbours(moved.axis[0].size());
  neighbours.find(moved, target_points);
  if (!within_reach(neighbours, source_points.count, config)) {
    return std::nullopt;
  }
  IcpAlignment alignment;
  bool converged = false;
  while (!converged && alignment.iterations < config.max_iterations) {
    ++alignment.iterations;
    alignment.T_target_source =
        least_squares_motion(source_points, target_points, neighbours.nearest);
    double const step_m = move_points(source_points, alignment.T_target_source, moved);
    std::vector<std::int32_t> const nearest_before = neighbours.nearest;
    neighbours.find(moved, target_points);
    converged = step_m <= config.min_step_m || neighbours.nearest == nearest_before;
  }
  alignment.sum_squared_m2 = sum_of(neighbours.squared_m2, source_points.count);
  alignment.rms_m = std::sqrt(alignment.sum_squared_m2 / static_cast<double>(source_points.count));
  bool const accepted = alignment.rms_m <= config.max_rms_m &&
                        longest_way_m(source_points, moved) <= config.max_displacement_m;
  return accepted ? std::optional(alignment) : std::nullopt;
}

}  // namespace credo
#endif  // HWY_ONCE
