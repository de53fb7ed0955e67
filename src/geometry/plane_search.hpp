#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/plane.hpp"

namespace credo {

/// Points to search for planes, one column a quantity, any one frame, metres.
struct PlaneSearchPoints {
  std::vector<float> x, y, z;
  /// Unit normals; NaN where there is none: such a point is judged by distance alone.
  std::vector<float> normal_x, normal_y, normal_z;
  /// How far this point may lie from a plane and still belong to it.
  std::vector<float> tolerance_m;
  /// The caller's name for the point, such as its position in the image.
  std::vector<std::uint32_t> source;

  [[nodiscard]] std::size_t size() const { return x.size(); }
  void reserve(std::size_t count);
  void add(Eigen::Vector3f const& point, Eigen::Vector3f const& normal, float tolerance,
           std::uint32_t name);
  /// The points at those positions, which rise.
  [[nodiscard]] PlaneSearchPoints at(std::span<std::uint32_t const> positions) const;
  /// Keeps the points whose flag is 0, in their order. `removed` has one flag a point.
  void remove(std::span<std::uint8_t const> removed);
};

/// How hypotheses are drawn.
enum class PlaneSampling : std::uint8_t {
  /// Three points, anywhere (Fischler and Bolles 1981): the thesis' way.
  kThreePoints,
  /// One point and its normal: needs few draws, as long as normals are good.
  kPointAndNormal,
};

struct PlaneSearchLimits {
  PlaneSampling sampling = PlaneSampling::kThreePoints;
  /// A point with a normal belongs to a plane only if they differ by at most this; pi switches it
  /// off.
  double max_angle_rad = 3.15;
  /// Draws stop once a better plane would have been found with this probability ...
  double confidence = 0.99;
  /// ... and after this many in any case.
  int max_hypotheses = 100;
  /// Hypotheses are compared on at most this many points, evenly spread; the winner's inliers are
  /// exact.
  int scoring_points = 4096;
  std::uint32_t seed = 1;
};

struct FoundPlane {
  /// Least-squares fit to the inliers; the sign of the normal is arbitrary.
  Plane plane;
  /// One flag a point: 1 = inlier.
  std::vector<std::uint8_t> inliers;
  std::size_t inlier_count = 0;
};

/// The plane with the most inliers that RANSAC finds, refined by least squares (thesis 3.2, one
/// round of algorithm 2). None for fewer than three points or where all draws are degenerate.
std::optional<FoundPlane> find_largest_plane(PlaneSearchPoints const& points,
                                             PlaneSearchLimits const& limits);

/// Least squares on the plane's inliers, which moves it and so them, until it rests or loses some.
FoundPlane refined(FoundPlane found, PlaneSearchPoints const& points, double max_angle_rad);

/// Marks the inliers of a given plane and counts them.
FoundPlane inliers_of(Plane const& plane, PlaneSearchPoints const& points, double max_angle_rad);

/// Least-squares plane through the flagged points, each weighted by 1 / tolerance^2; none where
/// they do not span a plane. `normal_hint` fixes the sign: the result has a positive component
/// along it.
std::optional<Plane> fit_plane(PlaneSearchPoints const& points, std::span<std::uint8_t const> flags,
                               Eigen::Vector3d const& normal_hint);

}  // namespace credo
