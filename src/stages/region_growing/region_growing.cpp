#include "stages/region_growing/region_growing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/pose_fusion.hpp"
#include "geometry/reachability/reachability.hpp"
#include "stages/region_growing/object_seeds.hpp"

namespace credo {
namespace {

/// An object on its way to its pixels.
struct Region {
  std::size_t observation = 0;
  ObjectPixels pixels;
};

void check(Frame const& frame, NormalMap const& normals, Segmentation const& segmentation) {
  Grid<float> const& depth = frame.cloud_camera.z;
  if (!depth.same_size(normals.z) || !depth.same_size(segmentation.labels)) {
    throw std::logic_error("grow_objects: a cloud of " + std::to_string(depth.width()) + "x" +
                           std::to_string(depth.height()) +
                           " pixels needs normals and labels of that size");
  }
}

/// With limits for an object that may be off.
RegionGrowingConfig widened(RegionGrowingConfig config, PoseDistribution const& pose,
                            ObjectShape const& shape, Symmetry const& symmetry) {
  double const radius_m =
      shape.bounds().min().cwiseAbs().cwiseMax(shape.bounds().max().cwiseAbs()).norm();
  double const off_m = largest_deviation_m(pose, radius_m, symmetry);
  config.max_distance_m += off_m;
  config.seed_distance_m += off_m;
  config.open_mesh_distance_m += off_m;
  return config;
}

std::vector<Region> regions_of(OrganizedCloud const& cloud, NormalMap const& normals,
                               Segmentation const& segmentation,
                               std::span<PoseDistribution const> poses_world,
                               ObjectShapes const& shapes, RegionGrowingConfig const& config) {
  std::vector<Region> regions;
  for (std::size_t i = 0; i < segmentation.objects.size(); ++i) {
    ObjectObservation const& object = segmentation.objects[i];
    auto const shape = shapes.find(object.type);
    if (shape == shapes.end()) {
      continue;
    }
    PlacedShape const placed{&shape->second,
                             poses_world[i].mean.inverse() * segmentation.T_world_camera};
    regions.push_back(
        {i, object_pixels(cloud, normals, placed,
                          widened(config, poses_world[i], shape->second, object.symmetry))});
  }
  return regions;
}

/// The part of an image that holds some pixels.
struct Window {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

Window window_around(std::vector<std::size_t> const& pixels, int image_width) {
  auto const width = static_cast<std::size_t>(image_width);
  int left = image_width;
  int right = 0;
  for (std::size_t const i : pixels) {
    left = std::min(left, static_cast<int>(i % width));
    right = std::max(right, static_cast<int>(i % width));
  }
  int const top = static_cast<int>(pixels.front() / width);
  int const bottom = static_cast<int>(pixels.back() / width);
  return {left, top, right - left + 1, bottom - top + 1};
}

template <typename T>
Grid<T> cut_out(Grid<T> const& grid, Window const& window) {
  Grid<T> part(window.width, window.height);
  for (int v = 0; v < window.height; ++v) {
    std::copy_n(grid.row(window.top + v).begin() + window.left, window.width, part.row(v).begin());
  }
  return part;
}

template <typename Vectors>
Vectors cut_out_vectors(Vectors const& grid, Window const& window) {
  Vectors part;
  part.x = cut_out(grid.x, window);
  part.y = cut_out(grid.y, window);
  part.z = cut_out(grid.z, window);
  return part;
}

/// Algorithm 1: the components, among allowed pixels that are free or its own, that hold one of its
/// own.
void grow(Region const& region, LabelCode own, OrganizedCloud const& cloud,
          NormalMap const& normals, RegionGrowingConfig const& config, LabelMap& labels) {
  if (region.pixels.allowed.empty()) {
    return;
  }
  Window const window = window_around(region.pixels.allowed, cloud.width());
  Grid<std::uint8_t> active(window.width, window.height);
  auto const width = static_cast<std::size_t>(cloud.width());
  for (std::size_t const i : region.pixels.allowed) {
    if (labels[i] == kUnassigned || labels[i] == own) {
      active[Pixel{static_cast<int>(i % width) - window.left,
                   static_cast<int>(i / width) - window.top}] = 1;
    }
  }
  std::vector<ComponentRun> const runs =
      component_runs(cut_out_vectors(cloud, window), cut_out_vectors(normals, window), active,
                     {.radius_m = static_cast<float>(config.radius_m),
                      .max_angle_rad = static_cast<float>(config.max_angle_rad)});
  std::vector<bool> holds_seed(runs.size(), false);
  auto const pixels_of = [&](ComponentRun const& run) {
    return labels.row(window.top + run.v)
        .subspan(static_cast<std::size_t>(window.left + run.begin),
                 static_cast<std::size_t>(run.end - run.begin));
  };
  for (ComponentRun const& run : runs) {
    if (std::ranges::find(pixels_of(run), own) != pixels_of(run).end()) {
      holds_seed[static_cast<std::size_t>(run.component)] = true;
    }
  }
  for (ComponentRun const& run : runs) {
    if (holds_seed[static_cast<std::size_t>(run.component)]) {
      std::ranges::fill(pixels_of(run), own);
    }
  }
}

}  // namespace

FieldList fields(RegionGrowingConfig& config) {
  return {
      {"radius_m",
       &config.radius_m,
       {0.001, 1},
       "m",
       "a region takes in points within this distance of its own"},
      {"max_angle_rad",
       &config.max_angle_rad,
       {0, 3.14},
       "rad",
       "points join a region if their normals differ by less than this"},
      {"bounds_margin_m",
       &config.bounds_margin_m,
       {0, 1},
       "m",
       "how far beyond its model's bounding box a region may grow, on each side"},
      {"max_distance_m",
       &config.max_distance_m,
       {0, 100},
       "m",
       "nor does a region grow farther than this from its model's surface; its seeds may lie "
       "farther"},
      {"max_model_angle_rad",
       &config.max_model_angle_rad,
       {0, 3.15},
       "rad",
       "normals of a region are within this angle of the model's; 3.15 = any, or none"},
      {"crease_radius_m",
       &config.crease_radius_m,
       {0, 1},
       "m",
       "at creases, where normals are blended, any face of the model within this distance will do"},
      {"seed_distance_m",
       &config.seed_distance_m,
       {0, 1},
       "m",
       "points as near outside a model seed its region like those inside"},
      {"open_mesh_distance_m",
       &config.open_mesh_distance_m,
       {0, 1},
       "m",
       "points as near to a mesh with holes, which has no inside, seed its region"},
      {"from_belief",
       &config.from_belief,
       {},
       "",
       "regions grow where belief and detection together have the object; false: where the "
       "detection "
       "has it"},
  };
}

Segmentation grow_objects(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                          ObjectShapes const& shapes, RegionGrowingConfig const& config) {
  std::vector<PoseDistribution> detected;
  for (ObjectObservation const& object : segmentation.objects) {
    detected.push_back({object.pose_world.mean, Matrix6d::Zero()});
  }
  return grow_objects(frame, normals, std::move(segmentation), detected, shapes, config);
}

Segmentation grow_objects(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                          std::span<PoseDistribution const> poses_world, ObjectShapes const& shapes,
                          RegionGrowingConfig const& config) {
  if (poses_world.size() != segmentation.objects.size()) {
    throw std::logic_error("grow_objects: " + std::to_string(poses_world.size()) + " poses for " +
                           std::to_string(segmentation.objects.size()) + " observations");
  }
  check(frame, normals, segmentation);
  OrganizedCloud const& cloud = frame.cloud_camera;
  LabelMap& labels = segmentation.labels;
  std::vector<Region> const regions =
      regions_of(cloud, normals, segmentation, poses_world, shapes, config);
  for (Region const& region : regions) {
    LabelCode const own = segmentation.objects[region.observation].label;
    for (std::size_t const i : region.pixels.seeds) {
      if (labels[i] == kUnassigned) {
        labels[i] = own;
      }
    }
  }
  for (Region const& region : regions) {
    ObjectObservation& object = segmentation.objects[region.observation];
    grow(region, object.label, cloud, normals, config, labels);
    object.pixel_count = static_cast<std::size_t>(std::ranges::count(labels, object.label));
  }
  return segmentation;
}

}  // namespace credo
