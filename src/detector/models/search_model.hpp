#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/object_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/facets.hpp"
#include "geometry/depth_patch.hpp"

namespace credo {

/// Two points on either side of a silhouette, at the depth of the inner one. Model frame.
struct OutlinePair {
  Eigen::Vector3f inside_model;
  Eigen::Vector3f outside_model;
  /// From the inner one to the silhouette.
  float inside_m = 0.0F;
};

/// What a model shows of itself from one side.
struct ModelView {
  /// Unit, from the model's centre to the camera.
  Eigen::Vector3f to_camera_model = Eigen::Vector3f::UnitZ();
  /// Positions in SearchModel::points_model, rising.
  std::vector<std::uint16_t> visible;
  /// Of its picture, at the distance of the centre.
  float area_m2 = 0.0F;
  std::vector<OutlinePair> outline;
};

/// A model made ready to be found in depth images. Model frame; immutable, for any number of
/// threads.
struct SearchModel {
  std::string name;
  Symmetry symmetry;
  /// What is behind its triangles was never seen: from there it shows nothing.
  bool one_sided = false;
  /// Of the box that bounds it.
  Eigen::Vector3f centre_model = Eigen::Vector3f::Zero();
  /// Of the sphere about the centre that holds it.
  float radius_m = 0.0F;
  /// Largest distance of two of its points.
  float diameter_m = 0.0F;
  /// Area of all its surface.
  float surface_m2 = 0.0F;

  /// On its surface, no two nearer than `spacing_m`, in random order: the first n are a sample of
  /// all. Those that no view shows are left out.
  std::vector<Eigen::Vector3f> points_model;
  /// Unit, outward; an open mesh that is not one-sided has each point twice, facing either way.
  std::vector<Eigen::Vector3f> normals_model;
  float spacing_m = 0.0F;

  /// Its flat pieces, if it has any; model frame.
  std::vector<Facet> facets;

  /// For rendering: the model's own mesh, or, where that is fine, one whose corners are no more
  /// than a seventieth of the diameter off.
  std::vector<Eigen::Vector3f> vertices_model;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// From the corners of a fine icosahedron. From behind a one-sided model some show nothing.
  std::vector<ModelView> views;

  /// Nearest to a direction from the centre to the camera, which need not be unit.
  [[nodiscard]] ModelView const& view_from(Eigen::Vector3f const& to_camera_model) const;
  /// Its depth at a pose.
  [[nodiscard]] DepthPatch rendered(CameraPose const& pose, CameraIntrinsics const& intrinsics,
                                    ImageSize size) const;
};

/// Throws InputError for a model without a surface: no triangles, or none with an area. An open
/// mesh is fine. The same for the same model, on every machine.
[[nodiscard]] SearchModel prepare_model(ObjectModel const& model);

}  // namespace credo
