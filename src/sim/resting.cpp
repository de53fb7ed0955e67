#include "sim/resting.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "geometry/convex_hull.hpp"
#include "geometry/shapes/mesh_edges.hpp"

namespace credo {
namespace {

constexpr double kSameFace_rad = 2.0 * std::numbers::pi / 180.0;
/// A bottle on its side touches a table along a narrow strip and stays; a screwdriver on its end
/// does not.
constexpr double kLeastSteadiness = 0.1;

struct Face {
  std::array<Eigen::Vector3d, 3> corners;
  Eigen::Vector3d normal;
  double area_m2 = 0.0;
};

std::vector<Face> hull_faces(TriangleMesh const& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    points.push_back(vertex.cast<double>());
  }
  std::vector<Face> faces;
  for (auto const& [a, b, c] : convex_hull(points)) {
    Eigen::Vector3d const across = (points[b] - points[a]).cross(points[c] - points[a]);
    if (across.norm() > 0.0) {
      faces.push_back({{points[a], points[b], points[c]}, across.normalized(), across.norm() / 2});
    }
  }
  return faces;
}

/// Whether a point's foot on the face's plane is inside the face.
bool is_over(Face const& face, Eigen::Vector3d const& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    Eigen::Vector3d const side = face.corners[(i + 1) % 3] - face.corners[i];
    if (face.normal.cross(side).dot(point - face.corners[i]) < 0.0) {
      return false;
    }
  }
  return true;
}

/// How far a body that rests on a face can be tilted before it falls, as a tangent: of the nearest
/// side of what touches the table, to a millimetre, over the height of the centre of mass.
double steadiness(Face const& face, std::vector<Face> const& faces, Eigen::Vector3d const& centre) {
  constexpr double kTouch_m = 0.001;
  Eigen::Vector3d const x = face.normal.unitOrthogonal();
  Eigen::Vector3d const y = face.normal.cross(x);
  std::vector<Eigen::Vector2d> touching;
  for (Face const& other : faces) {
    for (Eigen::Vector3d const& corner : other.corners) {
      if (face.normal.dot(face.corners[0] - corner) < kTouch_m) {
        touching.emplace_back(x.dot(corner), y.dot(corner));
      }
    }
  }
  return depth_inside(convex_polygon(touching), {x.dot(centre), y.dot(centre)}) /
         face.normal.dot(face.corners[0] - centre);
}

}  // namespace

Eigen::Vector3d centre_of_mass(TriangleMesh const& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double volume = 0.0;
  for (auto const& [a, b, c] : mesh.triangles) {
    Eigen::Vector3d const p = mesh.vertices[a].cast<double>();
    Eigen::Vector3d const q = mesh.vertices[b].cast<double>();
    Eigen::Vector3d const r = mesh.vertices[c].cast<double>();
    double const part = p.dot(q.cross(r));
    volume += part;
    sum += part * (p + q + r) / 4.0;
  }
  return sum / volume;
}

std::vector<Rest> rests_of(TriangleMesh const& mesh) {
  std::vector<Face> const faces = hull_faces(mesh);
  Eigen::Vector3d const centre = centre_of_mass(mesh);
  std::vector<Rest> rests;
  std::vector<Eigen::Vector3d> normals;
  double total = 0.0;
  for (Face const& face : faces) {
    bool passed_over = !is_over(face, centre) || steadiness(face, faces, centre) < kLeastSteadiness;
    for (Eigen::Vector3d const& normal : normals) {
      passed_over = passed_over || normal.dot(face.normal) > std::cos(kSameFace_rad);
    }
    if (passed_over) {
      continue;
    }
    double area_m2 = 0.0;
    for (Face const& other : faces) {
      area_m2 += other.normal.dot(face.normal) > std::cos(kSameFace_rad) ? other.area_m2 : 0.0;
    }
    normals.push_back(face.normal);
    rests.push_back(
        {Eigen::Quaterniond::FromTwoVectors(face.normal, -Eigen::Vector3d::UnitZ()), area_m2});
    total += area_m2;
  }
  for (Rest& rest : rests) {
    rest.share /= total;
  }
  return rests;
}

}  // namespace credo
