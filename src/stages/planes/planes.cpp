#include "stages/planes/planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/sampled_cells.hpp"
#include "geometry/thinning.hpp"
#include "stages/planes/holes.hpp"
#include "stages/planes/is_floor.hpp"
#include "stages/planes/is_wall.hpp"
#include "stages/planes/labelled_pixels.hpp"
#include "stages/planes/plane_pixels.hpp"
#include "stages/planes/plane_view.hpp"
#include "stages/planes/remaining_points.hpp"

namespace credo {
namespace {

PlaneTolerance tolerance_of(PlanesConfig const& config) {
  constexpr double kRightAngle = 1.5707963;
  return {static_cast<float>(config.inlier_distance_m), static_cast<float>(config.noise_sigmas),
          config.max_angle_rad < kRightAngle ? static_cast<float>(std::cos(config.max_angle_rad))
                                             : 0.0F};
}

/// Of segments' planes, points as many as cells need; the thesis' planes have all of them.
PixelSampling sampling_of(PlaneView const& view, Plane const& plane_camera) {
  auto const spacing_m = static_cast<float>(view.config.point_spacing_m);
  return PixelSampling::of_plane(spacing_m, view.pieces.empty() ? 0.0F : view.focal_px,
                                 plane_camera);
}

/// Writes the label on all of the plane's pixels and returns the world points of those that lie in
/// it, thinned.
PointList label_pixels(PlaneView const& view, PixelPlane const& plane, LabelCode code,
                       LabelMap& labels) {
  auto const width = static_cast<std::size_t>(labels.width());
  std::vector<PixelRun> runs;
  plane.inliers.pixels.for_each_run([&](std::size_t begin, std::size_t end) {
    std::fill(labels.data() + begin, labels.data() + end, code);
    while (begin < end) {
      std::size_t const row_end = std::min(end, (begin / width + 1) * width);
      runs.push_back({begin, row_end});
      begin = row_end;
    }
  });
  plane.joined.pixels.for_each_run([&](std::size_t begin, std::size_t end) {
    std::fill(labels.data() + begin, labels.data() + end, code);
  });
  PointList points;
  sampled_cells(view.cloud, runs, sampling_of(view, plane.camera), view.T_world_camera)
      .append_means(0, points);
  return points;
}

/// Returns what of the plane is floor.
PixelPlane add_floor(PlaneView const& view, PixelPlane plane, Segmentation& segmentation) {
  plane.inliers = low_pixels(view, std::move(plane.inliers));
  plane.joined = low_pixels(view, std::move(plane.joined));
  PointList added = label_pixels(view, plane, kFloor, segmentation.labels);
  std::size_t const pixel_count = plane.inliers.count + plane.joined.count;
  if (!segmentation.floor) {
    segmentation.floor = FloorObservation{plane.world, std::move(added), pixel_count};
    return plane;
  }
  // A later plane that passes too is more of the same floor; the largest one's fit stays.
  FloorObservation& floor = *segmentation.floor;
  floor.points_world.insert(floor.points_world.end(), added.begin(), added.end());
  floor.points_world =
      thin_points(floor.points_world, static_cast<float>(view.config.point_spacing_m));
  floor.pixel_count += pixel_count;
  return plane;
}

/// A plane of the picture that has been labelled.
FoundSurface found_surface(LabelCode label, PixelPlane plane) {
  if (plane.joined.count > 0) {
    plane.inliers.insert(plane.joined);
  }
  plane.open.insert(plane.turned);
  return {label, plane.camera, std::move(plane.inliers), std::move(plane.open)};
}

void add_wall(PlaneView const& view, PixelPlane const& plane, Segmentation& segmentation) {
  WallObservation wall;
  wall.label = static_cast<LabelCode>(kFirstWall + segmentation.walls.size());
  bool const faces_camera = plane.world.signed_distance_m(view.T_world_camera.translation()) >= 0.0;
  wall.plane_world = faces_camera ? plane.world : plane.world.flipped();
  wall.points_world = label_pixels(view, plane, wall.label, segmentation.labels);
  wall.pixel_count = plane.inliers.count + plane.joined.count;
  segmentation.walls.push_back(std::move(wall));
}

}  // namespace

Segmentation extract_planes(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                            PlanesConfig const& config) {
  PlaneView const view{frame.cloud_camera,
                       normals,
                       segmentation.T_world_camera,
                       segmentation.floor_at_zero,
                       static_cast<float>(frame.intrinsics.fx_px),
                       config,
                       tolerance_of(config),
                       PixelBoxes(frame.cloud_camera),
                       SegmentPieces(segmentation.segments),
                       pixels_with_depth(segmentation.labels)};
  CountedPixels free = unassigned_pixels(segmentation.labels, segmentation.segments, view.pieces);
  RemainingPoints remaining(view, segmentation.segments, free);
  std::vector<FoundSurface> found;
  auto const label = [&](PixelPlane plane) {
    if (is_floor(view, plane)) {
      remaining.settle(plane);
      found.push_back(found_surface(kFloor, add_floor(view, std::move(plane), segmentation)));
    } else if (segmentation.walls.size() < kMaxWalls && is_wall(view, plane)) {
      remaining.settle(plane);
      // It may have held hardly anything of all its segments.
      if (plane.inliers.count >= static_cast<std::size_t>(config.wall_min_pixels)) {
        add_wall(view, plane, segmentation);
        found.push_back(found_surface(segmentation.walls.back().label, std::move(plane)));
      }
    }
  };
  if (view.pieces.empty()) {
    auto seed = static_cast<std::uint32_t>(config.seed);
    for (int k = 0; k < config.max_planes; ++k) {
      std::optional<PixelPlane> plane = remaining.take_largest(seed++);
      if (!plane) {
        break;
      }
      label(*std::move(plane));
    }
  } else {
    for (Plane const& suggested : remaining.suggested()) {
      if (std::optional<PixelPlane> plane = remaining.take(suggested)) {
        label(*std::move(plane));
      }
    }
  }
  if (view.tolerance.min_cosine > 0.0F) {
    fill_holes(view, found, std::move(free), segmentation);
  }
  return segmentation;
}

}  // namespace credo
