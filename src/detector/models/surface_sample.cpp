#include "detector/models/surface_sample.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "geometry/random_draws.hpp"
#include "geometry/shapes/point_cells.hpp"

namespace credo {
namespace {

constexpr double kDartsPerPoint = 10.0;
constexpr float kSameSurfaceCosine = 0.5F;

/// Takes points that are far enough from all that it took before.
class Sieve {
public:
  explicit Sieve(float spacing_m) : spacing_squared_(spacing_m * spacing_m), cells_(spacing_m) {}

  bool takes(Eigen::Vector3f const& point) {
    bool free = true;
    cells_.around(point, [&](std::uint32_t taken) {
      free = free && (taken_[taken] - point).squaredNorm() >= spacing_squared_;
    });
    if (free) {
      cells_.add(point, static_cast<std::uint32_t>(taken_.size()));
      taken_.push_back(point);
    }
    return free;
  }

private:
  float spacing_squared_;
  PointCells cells_;
  std::vector<Eigen::Vector3f> taken_;
};

struct Corners {
  Eigen::Vector3f a, b, c;
};

Corners corners_of(TriangleMesh const& mesh, std::size_t triangle) {
  auto const& [a, b, c] = mesh.triangles[triangle];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// Twice the areas of all triangles before each, and of all.
std::vector<double> areas_before(TriangleMesh const& mesh) {
  std::vector<double> sums = {0.0};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Corners const corners = corners_of(mesh, t);
    sums.push_back(sums.back() + static_cast<double>(
                                     (corners.b - corners.a).cross(corners.c - corners.a).norm()));
  }
  return sums;
}

void even_out_normals(SurfaceSample& sample, float radius_m) {
  PointCells cells(radius_m);
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    cells.add(sample.points[i], static_cast<std::uint32_t>(i));
  }
  std::vector<Eigen::Vector3f> evened(sample.normals.size());
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    cells.around(sample.points[i], [&](std::uint32_t j) {
      bool const near = (sample.points[j] - sample.points[i]).squaredNorm() <= radius_m * radius_m;
      if (near && sample.normals[j].dot(sample.normals[i]) > kSameSurfaceCosine) {
        sum += sample.normals[j];
      }
    });
    evened[i] = sum.normalized();
  }
  sample.normals = std::move(evened);
}

}  // namespace

SurfaceSample sample_surface(TriangleMesh const& mesh, float spacing_m, std::uint64_t seed) {
  SurfaceSample sample;
  std::vector<double> const before = areas_before(mesh);
  double const doubled_area = before.back();
  sample.area_m2 = static_cast<float>(doubled_area / 2.0);
  double const spacing_squared = static_cast<double>(spacing_m) * static_cast<double>(spacing_m);
  auto const darts =
      static_cast<std::size_t>(std::ceil(kDartsPerPoint * doubled_area / 2.0 / spacing_squared));
  std::mt19937_64 random(seed);
  Sieve sieve(spacing_m);
  for (std::size_t i = 0; i < darts && doubled_area > 0.0; ++i) {
    double const place = draw_uniform(random) * doubled_area;
    auto const after = std::upper_bound(before.begin(), before.end(), place);
    auto const triangle =
        std::min(static_cast<std::size_t>(after - before.begin()) - 1, mesh.triangles.size() - 1);
    Corners const corners = corners_of(mesh, triangle);
    float const root = std::sqrt(static_cast<float>(draw_uniform(random)));
    auto const share = static_cast<float>(draw_uniform(random));
    Eigen::Vector3f const point =
        (1.0F - root) * corners.a + root * (1.0F - share) * corners.b + root * share * corners.c;
    Eigen::Vector3f const normal = (corners.b - corners.a).cross(corners.c - corners.a);
    if (normal.norm() > 0.0F && sieve.takes(point)) {
      sample.points.push_back(point);
      sample.normals.push_back(normal.normalized());
    }
  }
  even_out_normals(sample, 2.0F * spacing_m);
  return sample;
}

std::vector<std::uint32_t> apart(std::vector<Eigen::Vector3f> const& points, float spacing_m) {
  Sieve sieve(spacing_m);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sieve.takes(points[i])) {
      kept.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return kept;
}

}  // namespace credo
