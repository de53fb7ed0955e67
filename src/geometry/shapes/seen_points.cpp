#include "geometry/shapes/seen_points.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "geometry/shapes/point_cells.hpp"

namespace credo {
namespace {

constexpr std::size_t kSampled = 300;
constexpr int kFewestNeighbours = 8;
/// Sine of the flattest angle at which a surface is trusted.
constexpr float kLeastIncidence = 0.2F;

float distance_to_next(std::vector<Eigen::Vector3f> const& points, std::size_t of) {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i != of) {
      least = std::min(least, (points[i] - points[of]).squaredNorm());
    }
  }
  return std::sqrt(least);
}

/// Of the plane through a point's neighbours, either way round.
std::optional<Eigen::Vector3f> normal_at(std::vector<Eigen::Vector3f> const& points,
                                         PointCells const& cells, std::size_t at, float radius_m) {
  Eigen::Vector3f const& middle = points[at];
  // Relative to the point: far from the origin squares of floats would leave nothing.
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
  int count = -1;  // itself is no neighbour
  cells.around(middle, [&](std::uint32_t i) {
    Eigen::Vector3f const offset = points[i] - middle;
    if (offset.squaredNorm() <= radius_m * radius_m) {
      sum += offset;
      squares += offset * offset.transpose();
      ++count;
    }
  });
  if (count < kFewestNeighbours) {
    return std::nullopt;
  }
  Eigen::Vector3f const mean = sum / static_cast<float>(count + 1);
  Eigen::Matrix3f const scatter = squares - sum * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> const solver(scatter);
  return Eigen::Vector3f(solver.eigenvectors().col(0));
}

}  // namespace

SeenPoints seen_in(Frame const& frame, Eigen::AlignedBox3d const& box_source) {
  Eigen::Vector3d const middle = box_source.center();
  SeenPoints seen;
  seen.camera = (frame.T_source_camera.translation() - middle).cast<float>();
  OrganizedCloud const& cloud = frame.cloud_camera;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Eigen::Vector3d const p_source = frame.T_source_camera * cloud.at(i).cast<double>();
    // A point that is none (NaN) lies in no box.
    if (box_source.contains(p_source)) {
      seen.points.emplace_back((p_source - middle).cast<float>());
    }
  }
  return seen;
}

float typical_pitch_m(std::vector<SeenPoints> const& views) {
  std::vector<float> pitches_m;
  for (SeenPoints const& view : views) {
    std::size_t const count = view.points.size() < 2 ? 0 : std::min(kSampled, view.points.size());
    for (std::size_t i = 0; i < count; ++i) {
      pitches_m.push_back(distance_to_next(view.points, i * view.points.size() / count));
    }
  }
  if (pitches_m.empty()) {
    return 0.0F;
  }
  auto const half = pitches_m.begin() + static_cast<std::ptrdiff_t>(pitches_m.size() / 2);
  std::ranges::nth_element(pitches_m, half);
  return *half;
}

std::vector<OrientedPoint> with_normals(std::vector<SeenPoints> const& views, float radius_m) {
  std::vector<OrientedPoint> oriented;
  for (SeenPoints const& view : views) {
    PointCells cells(radius_m);
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      cells.add(view.points[i], static_cast<std::uint32_t>(i));
    }
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      auto const normal = normal_at(view.points, cells, i, radius_m);
      if (!normal) {
        continue;
      }
      float const incidence = normal->dot((view.camera - view.points[i]).normalized());
      if (std::abs(incidence) >= kLeastIncidence) {
        oriented.push_back({view.points[i], incidence > 0.0F ? *normal : -*normal});
      }
    }
  }
  return oriented;
}

}  // namespace credo
