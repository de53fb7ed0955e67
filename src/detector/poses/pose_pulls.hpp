#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/poses/edge_contacts.hpp"
#include "detector/poses/pose_refinement.hpp"
#include "detector/scenes/scene_projection.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

using Vector6f = Eigen::Matrix<float, 6, 1>;

/// A point of a model that the scene pulls at, and how much.
struct PosePull {
  Eigen::Vector3f point_camera;
  /// Unit: the model's normal, or outward from its silhouette.
  Eigen::Vector3f direction_camera;
  /// How far the scene's surface, or its end, lies that way.
  float residual_m = 0.0F;
  /// By how much that may err, one standard deviation.
  float deviation_m = 0.0F;
  float weight = 0.0F;

  /// How the point's place along the direction changes with a shift and a turn about `centre`.
  [[nodiscard]] Vector6f gradient(Eigen::Vector3f const& centre_camera) const {
    Vector6f row;
    row << direction_camera, (point_camera - centre_camera).cross(direction_camera);
    return row;
  }
};

/// Where points of the model's surface fall on the scene's.
class SurfacePulls {
public:
  SurfacePulls(SearchModel const& model, SearchScene const& scene, float gate_m)
      : model_(model), scene_(scene), project_(scene), gate_m_(gate_m) {}

  /// Of point `i` of the model; without its weight. None where nothing near is seen there, what is
  /// there lies on a plane larger than the model, or normals differ by more than 60 degrees.
  [[nodiscard]] std::optional<PosePull> at(CameraPose const& pose, std::uint16_t i) const {
    PosePull pull;
    pull.point_camera = pose * model_.points_model[i];
    Pixel pixel;
    if (!project_.at(pull.point_camera, pixel)) {
      return std::nullopt;
    }
    ScenePixel const& seen = scene_.pixels[pixel];
    if (seen.depth_m <= 0.0F || std::abs(seen.depth_m - pull.point_camera.z()) > gate_m_ ||
        scene_.is_background(seen, model_.diameter_m)) {
      return std::nullopt;
    }
    pull.direction_camera = pose.rotation * model_.normals_model[i];
    if (seen.has_normal() && seen.normal_camera().dot(pull.direction_camera) < kLeastNormalCosine) {
      return std::nullopt;
    }
    pull.residual_m = pull.direction_camera.dot(scene_.point_at(pixel) - pull.point_camera);
    pull.deviation_m = depth_deviation_m(pull.point_camera.z());
    return pull;
  }

private:
  static constexpr float kLeastNormalCosine = 0.5F;

  SearchModel const& model_;
  SearchScene const& scene_;
  SceneProjection project_;
  float gate_m_;
};

/// Fewer surface points tell nothing of a pose.
inline constexpr int kFewestSurfacePulls = 6;
/// So much of the surface's weight has the silhouette, if all of it is found.
inline constexpr float kEdgeShare = 0.5F;

/// All that pulls at a pose, with Cauchy weights: `on_surface(PosePull)` for every point of the
/// nearest view that falls on the scene's surface, then, if those are kFewestSurfacePulls or more,
/// `on_edge(PosePull)` for every point of its silhouette where the scene's surface ends. Returns
/// how many fall on the surface.
template <typename OnSurface, typename OnEdge>
int visit_pulls(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
                ModelView const& view, RefinementConfig const& config, OnSurface const& on_surface,
                OnEdge const& on_edge) {
  SurfacePulls const pulls(model, scene, config.gate_m);
  float const scale_m = 1.5F * depth_deviation_m((pose * model.centre_model).z());
  std::size_t const count = std::min(config.points, view.visible.size());
  int found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (std::optional<PosePull> pull = pulls.at(pose, view.visible[k])) {
      float const in_scales = pull->residual_m / scale_m;
      pull->weight = 1.0F / (1.0F + in_scales * in_scales);
      on_surface(*pull);
      ++found;
    }
  }
  if (found < kFewestSurfacePulls || view.outline.empty()) {
    return found;
  }
  float const of_each =
      kEdgeShare * static_cast<float>(found) / static_cast<float>(view.outline.size());
  for (OutlinePair const& pair : view.outline) {
    EdgeLook const look = look_at_edge(model, scene, pose, pair);
    if (look.verdict != EdgeVerdict::kFound) {
      continue;
    }
    EdgeContact const& edge = look.contact;
    float const in_deviations = edge.residual_m / (2.0F * edge.deviation_m);
    float const weight =
        std::min(1.0F, scale_m / edge.deviation_m) / (1.0F + in_deviations * in_deviations);
    on_edge(
        PosePull{edge.point, edge.direction, edge.residual_m, edge.deviation_m, of_each * weight});
  }
  return found;
}

}  // namespace credo
