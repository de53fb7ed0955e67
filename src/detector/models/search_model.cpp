#include "detector/models/search_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "detector/models/model_views.hpp"
#include "detector/models/surface_sample.hpp"
#include "detector/models/view_directions.hpp"
#include "geometry/shapes/mesh_edges.hpp"
#include "geometry/shapes/model_mesh.hpp"

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
  bool const twice = !model.one_sided && !is_closed(edges_of(mesh));
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    model.points_model.push_back(sample.points[i]);
    model.normals_model.push_back(sample.normals[i]);
    if (twice) {
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

/// A facet whose points fill less than half of its rectangle is no face to lay on another.
constexpr float kLeastFilled = 0.5F;
constexpr float kLeastFacetShare = 0.06F;
constexpr std::size_t kLeastFacetPoints = 20;

void set_facets(SearchModel& model) {
  std::vector<OrientedPoint> points;
  for (std::size_t i = 0; i < model.points_model.size(); ++i) {
    points.push_back({model.points_model[i], model.normals_model[i]});
  }
  // Poisson discs leave a point about 1.45 spacings squared.
  float const of_point_m2 = 1.45F * model.spacing_m * model.spacing_m;
  for (Facet const& facet :
       facets_of(std::move(points), model.spacing_m, kLeastFacetShare, kLeastFacetPoints)) {
    float const filled_m2 = static_cast<float>(facet.points) * of_point_m2;
    if (filled_m2 > kLeastFilled * 4.0F * facet.half_length_m * facet.half_width_m) {
      model.facets.push_back(facet);
    }
  }
}

/// Meshes of fewer triangles are rendered as they are.
constexpr std::size_t kFineTriangles = 2500;
constexpr float kCell_diameters = 1.0F / 70.0F;

/// Joins all vertices in a cube to their mean.
void set_rendered_mesh(SearchModel& model, TriangleMesh const& mesh) {
  model.vertices_model = mesh.vertices;
  model.triangles = mesh.triangles;
  if (mesh.triangles.size() <= kFineTriangles) {
    return;
  }
  float const cell_m = kCell_diameters * model.diameter_m;
  std::map<std::array<int, 3>, std::uint32_t> cells;
  std::vector<std::uint32_t> cell_of(mesh.vertices.size());
  std::vector<Eigen::Vector3f> sums;
  std::vector<float> counts;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Eigen::Array3i const place = (mesh.vertices[i] / cell_m).array().floor().cast<int>();
    auto const [known, is_new] =
        cells.try_emplace({place[0], place[1], place[2]}, static_cast<std::uint32_t>(sums.size()));
    if (is_new) {
      sums.emplace_back(Eigen::Vector3f::Zero());
      counts.push_back(0.0F);
    }
    cell_of[i] = known->second;
    sums[known->second] += mesh.vertices[i];
    counts[known->second] += 1.0F;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] /= counts[i];
  }
  std::set<std::array<std::uint32_t, 3>> known;
  model.triangles.clear();
  for (auto const& [a, b, c] : mesh.triangles) {
    std::array<std::uint32_t, 3> const joined = {cell_of[a], cell_of[b], cell_of[c]};
    bool const flat = joined[0] == joined[1] || joined[1] == joined[2] || joined[0] == joined[2];
    std::array<std::uint32_t, 3> sorted = joined;
    std::ranges::sort(sorted);
    if (!flat && known.insert(sorted).second) {
      model.triangles.push_back(joined);
    }
  }
  model.vertices_model = std::move(sums);
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
  if (one_sided) {
    return render_depth(vertices, facing_camera(vertices, triangles), intrinsics, size);
  }
  return render_depth(vertices, triangles, intrinsics, size);
}

SearchModel prepare_model(ObjectModel const& model) {
  TriangleMesh const mesh = mesh_of(model);
  SearchModel prepared;
  prepared.name = model.name;
  prepared.symmetry = model.symmetry;
  prepared.one_sided = model.one_sided;
  prepared.surface_m2 = area_of(mesh);
  if (mesh.triangles.empty() || !(prepared.surface_m2 > 0.0F)) {
    throw InputError("model " + model.name + ": has no surface, so nothing of it can be seen");
  }
  prepared.vertices_model = mesh.vertices;
  set_extent(prepared);
  set_rendered_mesh(prepared, mesh);
  set_points(prepared, mesh);
  prepared.views = views_of(prepared);
  drop_hidden_points(prepared);
  set_facets(prepared);
  return prepared;
}

}  // namespace credo
