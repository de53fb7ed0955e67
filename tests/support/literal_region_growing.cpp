#include "support/literal_region_growing.hpp"

#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

#include "geometry/reachability/reachability.hpp"

namespace credo::test {
namespace {

/// A model where it was detected, and what belongs to it.
struct Placed {
  ObjectShape shape;
  Se3 T_model_camera;
  LabelCode label;
};

std::vector<Placed> placed_models(Segmentation const& segmentation, ObjectModels const& models) {
  std::vector<Placed> placed;
  for (ObjectObservation const& object : segmentation.objects) {
    if (models.contains(object.type)) {
      placed.push_back({ObjectShape(models.at(object.type)),
                        object.pose_world.mean.inverse() * segmentation.T_world_camera,
                        object.label});
    }
  }
  return placed;
}

bool in_bounds(Placed const& object, Eigen::Vector3d const& p_model, double margin_m) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!(p_model[axis] >= object.shape.bounds().min()[axis] - margin_m) ||
        !(p_model[axis] <= object.shape.bounds().max()[axis] + margin_m)) {
      return false;
    }
  }
  return true;
}

bool is_near(Placed const& object, Eigen::Vector3d const& p_model, Eigen::Vector3f const& normal,
             double reach_m, RegionGrowingConfig const& config) {
  SurfaceDistance const surface = object.shape.distance_to(p_model);
  if (surface.distance_m > reach_m) {
    return false;
  }
  if (config.max_model_angle_rad >= std::numbers::pi) {
    return true;
  }
  if (!normal.allFinite()) {
    return false;
  }
  Eigen::Vector3d const n = object.T_model_camera.rotation() * normal.cast<double>();
  double const min_cosine = std::cos(config.max_model_angle_rad);
  return surface.normal.dot(n) > min_cosine ||
         (!object.shape.closed() && -surface.normal.dot(n) > min_cosine) ||
         object.shape.has_face_near(p_model, config.crease_radius_m, {n, min_cosine});
}

bool is_seed(Placed const& object, Eigen::Vector3d const& p_model, Eigen::Vector3f const& normal,
             RegionGrowingConfig const& config) {
  return is_near(object, p_model, normal,
                 object.shape.closed() ? config.seed_distance_m : config.open_mesh_distance_m,
                 config);
}

}  // namespace

LabelMap literal_regions(Frame const& frame, NormalMap const& normals,
                         Segmentation const& segmentation, ObjectModels const& models,
                         RegionGrowingConfig const& config) {
  OrganizedCloud const& cloud = frame.cloud_camera;
  LabelMap labels = segmentation.labels;
  std::vector<Placed> const objects = placed_models(segmentation, models);
  auto const in_model = [&](Placed const& object, std::size_t i) -> Eigen::Vector3d {
    return object.T_model_camera * cloud.at(i).cast<double>();
  };
  for (Placed const& object : objects) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == kUnassigned && cloud.valid(i) &&
          in_bounds(object, in_model(object, i), config.bounds_margin_m) &&
          is_seed(object, in_model(object, i), normals.at(i), config)) {
        labels[i] = object.label;
      }
    }
  }
  ReachThresholds const reach({.radius_m = static_cast<float>(config.radius_m),
                               .max_angle_rad = static_cast<float>(config.max_angle_rad)});
  for (Placed const& object : objects) {
    std::vector<std::size_t> free;
    std::queue<std::size_t> queue;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == object.label) {
        queue.push(i);
      } else if (labels[i] == kUnassigned && cloud.valid(i) &&
                 in_bounds(object, in_model(object, i), config.bounds_margin_m) &&
                 is_near(object, in_model(object, i), normals.at(i), config.max_distance_m,
                         config)) {
        free.push_back(i);
      }
    }
    for (; !queue.empty(); queue.pop()) {
      std::size_t const p = queue.front();
      std::erase_if(free, [&](std::size_t q) {
        bool const joins =
            within_reach(cloud.at(p), normals.at(p), cloud.at(q), normals.at(q), reach);
        if (joins) {
          labels[q] = object.label;
          queue.push(q);
        }
        return joins;
      });
    }
  }
  return labels;
}

}  // namespace credo::test
