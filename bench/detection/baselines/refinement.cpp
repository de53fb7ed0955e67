#include "refinement.hpp"

#include <pcl/registration/icp.h>

namespace credo {

SearchedCloud searched(NormalCloud::Ptr const& points) {
  SearchedCloud cloud{points, std::make_shared<pcl::search::KdTree<pcl::PointNormal>>(false)};
  cloud.tree->setInputCloud(points);
  return cloud;
}

Eigen::Isometry3f refined(NormalCloud::Ptr const& source, SearchedCloud const& target,
                          Eigen::Isometry3f const& target_pose, IcpLimits const& limits) {
  if (source->size() < 4) {
    return target_pose;
  }
  pcl::IterativeClosestPoint<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setInputSource(source);
  icp.setSearchMethodTarget(target.tree, true);
  icp.setInputTarget(target.points);
  icp.setMaximumIterations(limits.iterations);
  icp.setMaxCorrespondenceDistance(limits.max_distance_m);
  icp.setTransformationEpsilon(1e-9);
  NormalCloud moved;
  icp.align(moved, target_pose.inverse().matrix());
  Eigen::Isometry3f pose;
  // Rounding of many small motions is taken out.
  pose.matrix() = icp.getFinalTransformation();
  pose = pose.inverse();
  pose.linear() = Eigen::Quaternionf(pose.linear()).normalized().toRotationMatrix();
  return icp.hasConverged() && pose.matrix().allFinite() ? pose : target_pose;
}

}  // namespace credo
