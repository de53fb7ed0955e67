#include "stages/fusion/moved_segmentation.hpp"

#include <Eigen/Geometry>

namespace credo {
namespace {

Eigen::Vector3f moved(Eigen::Vector3f const& point, Se3 const& T_new_old) {
  return (T_new_old * point.cast<double>()).cast<float>();
}

void move(PointList& points, Se3 const& T_new_old) {
  for (Eigen::Vector3f& point : points) {
    point = moved(point, T_new_old);
  }
}

Eigen::AlignedBox3f moved(Eigen::AlignedBox3f const& box, Se3 const& T_new_old) {
  Eigen::AlignedBox3f around;
  if (box.isEmpty()) {
    return around;
  }
  for (int corner = 0; corner < 8; ++corner) {
    around.extend(
        moved(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)), T_new_old));
  }
  return around;
}

}  // namespace

Segmentation moved(Segmentation segmentation, Se3 const& T_new_old) {
  segmentation.T_world_camera = T_new_old * segmentation.T_world_camera;
  segmentation.T_world_told = T_new_old * segmentation.T_world_told;
  if (segmentation.floor) {
    segmentation.floor->plane_world = transformed(T_new_old, segmentation.floor->plane_world);
    move(segmentation.floor->points_world, T_new_old);
  }
  for (WallObservation& wall : segmentation.walls) {
    wall.plane_world = transformed(T_new_old, wall.plane_world);
    move(wall.points_world, T_new_old);
  }
  for (ObjectObservation& object : segmentation.objects) {
    object.pose_world = transformed(T_new_old, object.pose_world);
  }
  for (RefusedDetection& refused : segmentation.refused) {
    refused.pose_world = transformed(T_new_old, refused.pose_world);
  }
  for (StuffCluster& cluster : segmentation.stuff) {
    cluster.centroid_world = moved(cluster.centroid_world, T_new_old);
    cluster.bounds_world = moved(cluster.bounds_world, T_new_old);
    move(cluster.points_world, T_new_old);
  }
  return segmentation;
}

}  // namespace credo
