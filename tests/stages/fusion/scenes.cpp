#include "stages/fusion/scenes.hpp"

#include <cmath>
#include <utility>

namespace credo::test {
namespace {

PointList moved(Se3 const& motion, PointList points) {
  for (Eigen::Vector3f& p : points) {
    p = (motion * p.cast<double>()).cast<float>();
  }
  return points;
}

}  // namespace

FusionConfig thesis_config() {
  FusionConfig config;
  config.existence.max_log_odds = 0.0;
  config.existence.correlation_time_s = 0.0;
  config.objects.min_covariance_share = 0.0;
  config.objects.unseen_relaxation = 0.0;
  config.walls.segment_trim_ratio = 0.0;
  config.walls.merge_known = false;
  config.visibility = false;
  config.stuff.max_rms_m = 0.0;
  config.stuff.max_displacement_m = 0.0;
  return config;
}

StuffCluster cluster_of(LabelCode label, PointList points) {
  StuffCluster cluster;
  cluster.label = label;
  cluster.pixel_count = 10 * points.size();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (Eigen::Vector3f const& p : points) {
    sum += p;
    cluster.bounds_world.extend(p);
  }
  cluster.centroid_world = sum / static_cast<float>(points.size());
  cluster.points_world = std::move(points);
  return cluster;
}

StuffCluster box_cluster(LabelCode label, Eigen::Vector3f const& corner,
                         Eigen::Vector3f const& size) {
  constexpr float kSpacing = 0.02F;
  PointList points;
  Eigen::Vector3i const steps = (size / kSpacing).array().round().cast<int>();
  for (int i = 0; i <= steps.x(); ++i) {
    for (int j = 0; j <= steps.y(); ++j) {
      for (int k = 0; k <= steps.z(); ++k) {
        if (i == 0 || j == 0 || k == steps.z()) {
          points.emplace_back(corner + kSpacing * Eigen::Vector3i(i, j, k).cast<float>());
        }
      }
    }
  }
  return cluster_of(label, std::move(points));
}

WallObservation wall(LabelCode label, Eigen::Vector2d const& start, Eigen::Vector2d const& end) {
  WallObservation seen;
  seen.label = label;
  Eigen::Vector2d const along = end - start;
  seen.plane_world.normal = Eigen::Vector3d(-along.y(), along.x(), 0.0).normalized();
  seen.plane_world.offset_m =
      seen.plane_world.normal.dot(Eigen::Vector3d(start.x(), start.y(), 0.0));
  auto const steps = static_cast<int>(std::lround(along.norm() / 0.1));
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= 20; ++k) {
      Eigen::Vector2d const foot = start + along * (static_cast<double>(i) / steps);
      seen.points_world.emplace_back(Eigen::Vector3d(foot.x(), foot.y(), 0.1 * k).cast<float>());
    }
  }
  seen.pixel_count = 10 * seen.points_world.size();
  return seen;
}

FloorObservation floor_patch(Eigen::Vector2f const& min, Eigen::Vector2f const& max,
                             float height_m) {
  FloorObservation seen;
  seen.plane_world.offset_m = static_cast<double>(height_m);
  Eigen::Vector2i const steps = ((max - min) / 0.1F).array().round().cast<int>();
  for (int i = 0; i <= steps.x(); ++i) {
    for (int j = 0; j <= steps.y(); ++j) {
      // In the middle of a grid cell, so that rounding moves no point to the next.
      seen.points_world.emplace_back(min.x() + 0.1F * static_cast<float>(i) + 0.02F,
                                     min.y() + 0.1F * static_cast<float>(j) + 0.02F, height_m);
    }
  }
  seen.pixel_count = 10 * seen.points_world.size();
  return seen;
}

Segmentation empty_segmentation(int number) {
  Segmentation segmentation;
  segmentation.frame = FrameIndex{number};
  segmentation.segmented_with = FrameIndex{number - 1};
  segmentation.stamp_ns = static_cast<std::int64_t>(number) * 1'000'000'000 / 30;
  return segmentation;
}

Segmentation moved(Se3 const& motion, Segmentation segmentation) {
  segmentation.T_world_camera = motion * segmentation.T_world_camera;
  if (segmentation.floor) {
    segmentation.floor->plane_world = transformed(motion, segmentation.floor->plane_world);
    segmentation.floor->points_world = moved(motion, std::move(segmentation.floor->points_world));
  }
  for (WallObservation& seen : segmentation.walls) {
    seen.plane_world = transformed(motion, seen.plane_world);
    seen.points_world = moved(motion, std::move(seen.points_world));
  }
  for (StuffCluster& seen : segmentation.stuff) {
    std::size_t const pixels = seen.pixel_count;
    seen = cluster_of(seen.label, moved(motion, std::move(seen.points_world)));
    seen.pixel_count = pixels;
  }
  return segmentation;
}

}  // namespace credo::test
