#include "support/meshes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace credo::test {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

Corners corners_of(TriangleMesh const& mesh, std::size_t triangle) {
  auto const& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]].cast<double>(), mesh.vertices[t[1]].cast<double>(),
          mesh.vertices[t[2]].cast<double>()};
}

double to_segment(Vector3d const& a, Vector3d const& b, Vector3d const& p) {
  double const share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - share * (b - a)).norm();
}

// Where a line through p meets the triangle's plane inside it, told by barycentric weights.
bool crosses(Corners const& c, Vector3d const& p, Vector3d const& direction, double& along) {
  Eigen::Matrix3d m;
  m << c[1] - c[0], c[2] - c[0], -direction;
  Vector3d const x = m.fullPivLu().solve(p - c[0]);
  along = x[2];
  return std::isfinite(x.sum()) && x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1;
}

double to_triangle(Corners const& c, Vector3d const& p) {
  double along = 0;
  Vector3d const normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
  double least =
      crosses(c, p, normal, along) ? std::abs(along) : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min(least, to_segment(c[k], c[(k + 1) % 3], p));
  }
  return least;
}

bool inside(TriangleMesh const& mesh, Vector3d const& p) {
  int votes = 0;
  for (Vector3d const& direction :
       {Vector3d(0.31, 0.77, 0.56), Vector3d(-0.62, 0.17, -0.35), Vector3d(0.43, -0.91, 0.11)}) {
    int crossed = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      double along = 0;
      crossed += crosses(corners_of(mesh, t), p, direction, along) && along > 0 ? 1 : 0;
    }
    votes += crossed % 2;
  }
  return votes >= 2;
}

}  // namespace

TriangleMesh wavy_ring(int around, int across) {
  constexpr double kTurn = 2 * std::numbers::pi;
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      double const a = kTurn * i / around;
      double const b = kTurn * k / across;
      double const tube = 0.04 + 0.015 * std::sin(3 * a) + 0.008 * std::cos(5 * b);
      double const from_axis = 0.1 + tube * std::cos(b);
      mesh.vertices.emplace_back(Vector3d(from_axis * std::cos(a), from_axis * std::sin(a),
                                          tube * std::sin(b) + 0.02 * std::cos(2 * a))
                                     .cast<float>());
    }
  }
  auto const vertex = [&](int i, int k) {
    return static_cast<std::uint32_t>(i % around * across + k % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
      mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
    }
  }
  return mesh;
}

double literal_mesh_distance(TriangleMesh const& mesh, Vector3d const& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    least = std::min(least, to_triangle(corners_of(mesh, t), point));
  }
  return inside(mesh, point) ? -least : least;
}

double literal_mesh_hit(TriangleMesh const& mesh, Vector3d const& origin,
                        Vector3d const& direction) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double along = 0;
    if (crosses(corners_of(mesh, t), origin, direction, along) && along >= 0) {
      least = std::min(least, along);
    }
  }
  return least;
}

}  // namespace credo::test
