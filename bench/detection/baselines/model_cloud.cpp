#include "model_cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <variant>

#include "geometry/shapes/mesh_edges.hpp"

namespace credo {
namespace {

/// A point anywhere on the surface, each place as likely.
class SurfaceSampler {
public:
  explicit SurfaceSampler(TriangleMesh const& mesh) : mesh_(mesh) {
    std::vector<double> areas;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      areas.push_back(area_vector(mesh, i).norm() / 2.0);
      area_m2_ += areas.back();
    }
    any_triangle_ = std::discrete_distribution<std::size_t>(areas.begin(), areas.end());
  }

  [[nodiscard]] double area_m2() const { return area_m2_; }

  pcl::PointNormal operator()(std::mt19937_64& random) {
    std::size_t const triangle = any_triangle_(random);
    auto const& [a, b, c] = mesh_.triangles[triangle];
    std::uniform_real_distribution<float> share;
    float const s = std::sqrt(share(random));
    float const t = share(random);
    pcl::PointNormal point;
    point.getVector3fMap() = (1.0F - s) * mesh_.vertices[a] + s * (1.0F - t) * mesh_.vertices[b] +
                             s * t * mesh_.vertices[c];
    point.getNormalVector3fMap() = area_vector(mesh_, triangle).normalized().cast<float>();
    return point;
  }

private:
  TriangleMesh const& mesh_;
  std::discrete_distribution<std::size_t> any_triangle_;
  double area_m2_ = 0.0;
};

/// Keeps points that none kept so far is near to on the same side of a wall.
class Thinner {
public:
  explicit Thinner(double spacing_m) : spacing_m_(static_cast<float>(spacing_m)) {}

  bool keep(pcl::PointNormal const& point) {
    Cell const cell = cell_of(point.getVector3fMap());
    for (int i = 0; i < 27; ++i) {
      auto const found =
          cells_.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (found == cells_.end()) {
        continue;
      }
      for (pcl::PointNormal const& other : found->second) {
        if ((other.getVector3fMap() - point.getVector3fMap()).norm() < spacing_m_ &&
            other.getNormalVector3fMap().dot(point.getNormalVector3fMap()) > 0.3F) {
          return false;
        }
      }
    }
    cells_[cell].push_back(point);
    return true;
  }

private:
  using Cell = std::array<int, 3>;
  [[nodiscard]] Cell cell_of(Eigen::Vector3f const& p) const {
    Eigen::Vector3i const cell = (p / spacing_m_).array().floor().cast<int>();
    return {cell.x(), cell.y(), cell.z()};
  }

  float spacing_m_;
  std::map<Cell, std::vector<pcl::PointNormal>> cells_;
};

double angle_between(Eigen::Quaternionf const& a, Eigen::Quaternionf const& b,
                     Symmetry const& symmetry) {
  if (symmetry.axis) {
    Eigen::Vector3f const axis = symmetry.axis->direction.cast<float>();
    float const cosine = (a * axis).dot(b * axis);
    return std::acos(
        std::min(symmetry.axis->both_ways ? std::abs(cosine) : std::max(cosine, -1.0F), 1.0F));
  }
  double angle = a.angularDistance(b);
  for (Eigen::Quaterniond const& turn : symmetry.rotations) {
    angle = std::min<double>(angle, a.angularDistance(b * turn.cast<float>()));
  }
  return angle;
}

}  // namespace

ModelCloud model_cloud(ObjectModel const& model, double spacing_m) {
  auto const* const mesh = std::get_if<TriangleMesh>(&model.shape);
  if (mesh == nullptr) {
    throw std::logic_error("model_cloud: " + model.name + " is not a mesh");
  }
  ModelCloud result{model.name, model.symmetry, std::make_shared<NormalCloud>(), 0.0};
  SurfaceSampler sample(*mesh);
  Thinner thinner(spacing_m);
  std::mt19937_64 random(1);
  auto const tries = static_cast<std::size_t>(12.0 * sample.area_m2() / (spacing_m * spacing_m));
  for (std::size_t i = 0; i < tries; ++i) {
    pcl::PointNormal const point = sample(random);
    if (thinner.keep(point)) {
      result.points->push_back(point);
    }
  }
  for (auto const& a : *result.points) {
    for (auto const& b : *result.points) {
      result.diameter_m =
          std::max<double>(result.diameter_m, (a.getVector3fMap() - b.getVector3fMap()).norm());
    }
  }
  return result;
}

NormalCloud::Ptr first_points(NormalCloud const& points, std::size_t count) {
  auto result = std::make_shared<NormalCloud>();
  result->insert(result->end(), points.begin(),
                 points.begin() + static_cast<std::ptrdiff_t>(std::min(count, points.size())));
  return result;
}

NormalCloud::Ptr facing_points(NormalCloud const& points, Eigen::Isometry3f const& pose_camera) {
  Eigen::Vector3f const eye = pose_camera.inverse().translation();
  auto result = std::make_shared<NormalCloud>();
  for (pcl::PointNormal const& point : points) {
    if (point.getNormalVector3fMap().dot(eye - point.getVector3fMap()) > 0.0F) {
      result->push_back(point);
    }
  }
  return result;
}

std::vector<Eigen::Quaternionf> spread_turns(Symmetry const& symmetry, double apart_deg) {
  constexpr int kTries = 4000;
  double const apart = apart_deg * std::numbers::pi / 180.0;
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal;
  std::vector<Eigen::Quaternionf> turns;
  for (int i = 0; i < kTries; ++i) {
    float const w = normal(random);
    float const x = normal(random);
    float const y = normal(random);
    float const z = normal(random);
    Eigen::Quaternionf const turn = Eigen::Quaternionf(w, x, y, z).normalized();
    if (std::ranges::none_of(turns, [&](Eigen::Quaternionf const& other) {
          return angle_between(other, turn, symmetry) < apart;
        })) {
      turns.push_back(turn);
    }
  }
  return turns;
}

}  // namespace credo
