#include "geometry/shapes/mesh_distance.hpp"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shapes/mesh_edges.hpp"
#include "geometry/shapes/triangle.hpp"

namespace credo {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

void check(TriangleMesh const& mesh) {
  if (mesh.triangles.empty()) {
    throw std::logic_error("MeshDistance: the mesh has no triangles");
  }
  for (auto const& triangle : mesh.triangles) {
    for (std::uint32_t const vertex : triangle) {
      if (vertex >= mesh.vertices.size()) {
        throw std::logic_error("MeshDistance: a triangle names vertex " + std::to_string(vertex) +
                               " of " + std::to_string(mesh.vertices.size()));
      }
    }
  }
}

// A little more than a distance, because the tree's boxes and the point are in floats.
constexpr double kSlack = 1.0 + 1e-4;
constexpr double kSlack_m = 1e-5;

void check_finite(Eigen::Vector3d const& point) {
  if (!point.allFinite()) {
    throw std::logic_error("MeshDistance: the point is not finite");
  }
}

/// The nearest triangle so far.
struct Nearest {
  double distance2 = std::numeric_limits<double>::infinity();
  std::size_t triangle = 0;
  NearestOnTriangle on_triangle;
};

}  // namespace

struct MeshDistance::Tree {
  explicit Tree(TriangleMesh const& mesh);

  void offer(std::size_t triangle, Eigen::Vector3d const& point, Nearest& nearest) const;
  [[nodiscard]] Nearest nearest_to(Eigen::Vector3d const& point) const;
  [[nodiscard]] bool has_face_near(Eigen::Vector3d const& point, double radius_m,
                                   DirectionCone const& cone) const;
  /// Points outward wherever the point is nearest to that part of that triangle.
  [[nodiscard]] Eigen::Vector3d const& pseudonormal(Nearest const& nearest) const;

  std::vector<std::array<Eigen::Vector3d, 3>> corners;
  std::vector<std::array<std::uint32_t, 3>> vertices_of;
  std::vector<Eigen::Vector3d> face_normals;
  std::vector<std::array<Eigen::Vector3d, 3>> edge_normals;
  std::vector<Eigen::Vector3d> vertex_normals;
  bool closed = false;
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene;

private:
  void add_normals(TriangleMesh const& mesh);
  void build_scene(TriangleMesh const& mesh);
};

MeshDistance::Tree::Tree(TriangleMesh const& mesh)
    : vertices_of(mesh.triangles), device(rtcNewDevice(nullptr)), scene(rtcNewScene(device.get())) {
  for (auto const& triangle : mesh.triangles) {
    corners.push_back({mesh.vertices[triangle[0]].cast<double>(),
                       mesh.vertices[triangle[1]].cast<double>(),
                       mesh.vertices[triangle[2]].cast<double>()});
  }
  add_normals(mesh);
  build_scene(mesh);
}

void MeshDistance::Tree::add_normals(TriangleMesh const& mesh) {
  vertex_normals.assign(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < corners.size(); ++t) {
    face_normals.emplace_back(area_vector(mesh, t).normalized());
    for (std::size_t k = 0; k < 3; ++k) {
      Eigen::Vector3d const to_next = corners[t][(k + 1) % 3] - corners[t][k];
      Eigen::Vector3d const to_last = corners[t][(k + 2) % 3] - corners[t][k];
      double const angle = std::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last));
      vertex_normals[vertices_of[t][k]] += angle * face_normals[t];
    }
  }
  std::vector<MeshEdge> const edges = edges_of(mesh);
  closed = is_closed(edges);
  edge_normals.resize(corners.size());
  for (MeshEdge const& edge : edges) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto const& side : {edge.left, edge.right}) {
      sum += side ? face_normals[*side] : Eigen::Vector3d::Zero();
    }
    for (auto const& [side, from] : {std::pair(edge.left, edge.begin), {edge.right, edge.end}}) {
      if (side) {
        auto const& corner = vertices_of[*side];
        auto const k = static_cast<std::size_t>(std::ranges::find(corner, from) - corner.begin());
        edge_normals[*side][k] = sum;
      }
    }
  }
}

void MeshDistance::Tree::build_scene(TriangleMesh const& mesh) {
  if (scene == nullptr) {
    throw std::runtime_error("Embree does not start on this machine");
  }
  RTCGeometry triangles = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex_buffer = static_cast<float*>(
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    vertex_buffer = std::copy_n(vertex.data(), 3, vertex_buffer);
  }
  auto* index_buffer = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  for (auto const& triangle : mesh.triangles) {
    index_buffer = std::copy(triangle.begin(), triangle.end(), index_buffer);
  }
  rtcCommitGeometry(triangles);
  rtcAttachGeometry(scene.get(), triangles);
  rtcReleaseGeometry(triangles);
  rtcCommitScene(scene.get());
}

void MeshDistance::Tree::offer(std::size_t triangle, Eigen::Vector3d const& point,
                               Nearest& nearest) const {
  NearestOnTriangle const candidate = nearest_on_triangle(corners[triangle], point);
  double const distance2 = (point - candidate.point).squaredNorm();
  if (distance2 < nearest.distance2 ||
      (distance2 == nearest.distance2 && triangle < nearest.triangle)) {
    nearest = {distance2, triangle, candidate};
  }
}

Nearest MeshDistance::Tree::nearest_to(Eigen::Vector3d const& point) const {
  struct Search {
    Tree const* tree;
    Eigen::Vector3d point;
    Nearest nearest;
  } search{this, point, {}};
  auto const visit = [](RTCPointQueryFunctionArguments* arguments) {
    auto& found = *static_cast<Search*>(arguments->userPtr);
    found.tree->offer(arguments->primID, found.point, found.nearest);
    auto const radius = static_cast<float>(kSlack * std::sqrt(found.nearest.distance2) + kSlack_m);
    if (radius < arguments->query->radius) {
      arguments->query->radius = radius;
      return true;
    }
    return false;
  };
  Eigen::Vector3f const p = point.cast<float>();
  RTCPointQuery query{p.x(), p.y(), p.z(), 0.0F, std::numeric_limits<float>::infinity()};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene.get(), &query, &context, visit, &search);
  return search.nearest;
}

bool MeshDistance::Tree::has_face_near(Eigen::Vector3d const& point, double radius_m,
                                       DirectionCone const& cone) const {
  struct Search {
    Tree const* tree;
    Eigen::Vector3d point;
    double radius_m;
    DirectionCone cone;
    bool found;
  } search{this, point, radius_m, cone, false};
  auto const visit = [](RTCPointQueryFunctionArguments* arguments) {
    auto& asked = *static_cast<Search*>(arguments->userPtr);
    std::size_t const t = arguments->primID;
    Eigen::Vector3d const& normal = asked.tree->face_normals[t];
    if (!asked.cone.holds(normal) && (asked.tree->closed || !asked.cone.holds(-normal))) {
      return false;
    }
    Eigen::Vector3d const nearest = nearest_on_triangle(asked.tree->corners[t], asked.point).point;
    asked.found =
        asked.found || (asked.point - nearest).squaredNorm() <= asked.radius_m * asked.radius_m;
    if (asked.found) {
      arguments->query->radius = 0.0F;
    }
    return asked.found;
  };
  Eigen::Vector3f const p = point.cast<float>();
  RTCPointQuery query{p.x(), p.y(), p.z(), 0.0F, static_cast<float>(kSlack * radius_m + kSlack_m)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene.get(), &query, &context, visit, &search);
  return search.found;
}

Eigen::Vector3d const& MeshDistance::Tree::pseudonormal(Nearest const& nearest) const {
  std::size_t const t = nearest.triangle;
  switch (nearest.on_triangle.part) {
    case TrianglePart::kFace:
      break;
    case TrianglePart::kEdge0:
      return edge_normals[t][0];
    case TrianglePart::kEdge1:
      return edge_normals[t][1];
    case TrianglePart::kEdge2:
      return edge_normals[t][2];
    case TrianglePart::kCorner0:
      return vertex_normals[vertices_of[t][0]];
    case TrianglePart::kCorner1:
      return vertex_normals[vertices_of[t][1]];
    case TrianglePart::kCorner2:
      return vertex_normals[vertices_of[t][2]];
  }
  return face_normals[t];
}

MeshDistance::MeshDistance(TriangleMesh const& mesh) {
  check(mesh);
  tree_ = std::make_unique<Tree>(mesh);
}

MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;
MeshDistance::~MeshDistance() = default;

bool MeshDistance::closed() const {
  return tree_->closed;
}

SurfaceDistance MeshDistance::operator()(Eigen::Vector3d const& point_model) const {
  check_finite(point_model);
  Nearest const nearest = tree_->nearest_to(point_model);
  Eigen::Vector3d const offset = point_model - nearest.on_triangle.point;
  bool const inside = tree_->closed && tree_->pseudonormal(nearest).dot(offset) < 0.0;
  double const distance = std::sqrt(nearest.distance2);
  return {inside ? -distance : distance, tree_->face_normals[nearest.triangle]};
}

bool MeshDistance::has_face_near(Eigen::Vector3d const& point_model, double radius_m,
                                 DirectionCone const& cone) const {
  check_finite(point_model);
  return tree_->has_face_near(point_model, radius_m, cone);
}

}  // namespace credo
