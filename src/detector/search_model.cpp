#include "detector/search_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "detector/model_views.hpp"
#include "detector/surface_sample.hpp"
#include "detector/view_directions.hpp"
#include "geometry/mesh_edges.hpp"
#include "geometry/model_mesh.hpp"

namespace credo {
namespace {

constexpr float kFinestSpacing_m = 0.004F;
/// Large models are sampled more coarsely.
constexpr float kMaxPoints = 4000.0F;
constexpr std::uint64_t kSampleSeed = 1;

float area_of(TriangleMesh const& mesh) {
  double doubled = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    doubled += area_vector(mesh, t).norm();
  }
  return static_cast<float>(doubled / 2.0);
}

/// Largest distance between the outermost points in each of many directions.
float diameter_of(std::vector<Eigen::Vector3f> const& vertices) {
  std::vector<Eigen::Vector3f> outermost;
  for (Eigen::Vector3f const& direction : view_directions()) {
    outermost.push_back(*std::ranges::max_element(
        vertices, {}, [&](Eigen::Vector3f const& vertex) { return vertex.dot(direction); }));
  }
  float most_m = 0.0F;
  for (Eigen::Vector3f const& a : outermost) {
    for (Eigen::Vector3f const& b : outermost) {
      most_m = std::max(most_m, (a - b).norm());
    }
  }
  return most_m;
}

void set_extent(SearchModel& model) {
  Eigen::AlignedBox3f bounds;
  for (Eigen::Vector3f const& vertex : model.vertices_model) {
    bounds.extend(vertex);
  }
  model.centre_model = bounds.center();
  for (Eigen::Vector3f const& vertex : model.vertices_model) {
    model.radius_m = std::max(model.radius_m, (vertex - model.centre_model).norm());
  }
  model.diameter_m = diameter_of(model.vertices_model);
}

void set_points(SearchModel& model, TriangleMesh const& mesh) {
  model.spacing_m = std::max(kFinestSpacing_m, std::sqrt(model.surface_m2 / kMaxPoints));
  SurfaceSample const sample = sample_surface(mesh, model.spacing_m, kSampleSeed);
  bool const closed = is_closed(edges_of(mesh));
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    model.points_model.push_back(sample.points[i]);
    model.normals_model.push_back(sample.normals[i]);
    if (!closed) {
      model.points_model.push_back(sample.points[i]);
      model.normals_model.emplace_back(-sample.normals[i]);
    }
  }
}

/// Leaves out the points that no view shows; the views' positions are told anew.
void drop_hidden_points(SearchModel& model) {
  std::vector<bool> seen(model.points_model.size(), false);
  for (ModelView const& view : model.views) {
    for (std::uint16_t const i : view.visible) {
      seen[i] = true;
    }
  }
  std::vector<std::uint16_t> moved_to(model.points_model.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < model.points_model.size(); ++i) {
    if (seen[i]) {
      moved_to[i] = static_cast<std::uint16_t>(kept);
      model.points_model[kept] = model.points_model[i];
      model.normals_model[kept] = model.normals_model[i];
      ++kept;
    }
  }
  model.points_model.resize(kept);
  model.normals_model.resize(kept);
  for (ModelView& view : model.views) {
    for (std::uint16_t& i : view.visible) {
      i = moved_to[i];
    }
  }
}

}  // namespace

ModelView const& SearchModel::view_from(Eigen::Vector3f const& to_camera_model) const {
  return *std::ranges::max_element(
      views, {}, [&](ModelView const& view) { return view.to_camera_model.dot(to_camera_model); });
}

DepthPatch SearchModel::rendered(CameraPose const& pose, CameraIntrinsics const& intrinsics,
                                 ImageSize size) const {
  std::vector<Eigen::Vector3f> vertices;
  vertices.reserve(vertices_model.size());
  for (Eigen::Vector3f const& vertex : vertices_model) {
    vertices.push_back(pose * vertex);
  }
  return render_depth(vertices, triangles, intrinsics, size);
}

SearchModel prepare_model(ObjectModel const& model) {
  TriangleMesh const mesh = mesh_of(model);
  SearchModel prepared;
  prepared.name = model.name;
  prepared.symmetry = model.symmetry;
  prepared.surface_m2 = area_of(mesh);
  if (mesh.triangles.empty() || !(prepared.surface_m2 > 0.0F)) {
    throw InputError("model " + model.name + ": has no surface, so nothing of it can be seen");
  }
  prepared.vertices_model = mesh.vertices;
  prepared.triangles = mesh.triangles;
  set_extent(prepared);
  set_points(prepared, mesh);
  prepared.views = views_of(prepared);
  drop_hidden_points(prepared);
  return prepared;
}

}  // namespace credo
