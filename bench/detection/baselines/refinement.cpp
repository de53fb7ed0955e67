#include "refinement.hpp"

#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

namespace credo {
namespace {

using PlaneStep =
    pcl::registration::TransformationEstimationPointToPlaneLLS<pcl::PointNormal, pcl::PointNormal>;

/// The step that brings points onto the planes of those they are nearest to. PCL's own inverts a
/// matrix that is singular on planes and round things: here it is damped.
class DampedPlaneStep : public PlaneStep {
public:
  using PlaneStep::estimateRigidTransformation;
  void estimateRigidTransformation(NormalCloud const& source, NormalCloud const& target,
                                   pcl::Correspondences const& pairs,
                                   Eigen::Matrix4f& step) const override {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    constexpr double kDamping = 0.005;  // of a point that tells all directions
    constexpr double kLever_m = 0.05;   // of its turns
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (pcl::Correspondence const& pair : pairs) {
      middle += position(source, pair.index_query) / static_cast<double>(pairs.size());
    }
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    Vector6 gradient = Vector6::Zero();
    for (pcl::Correspondence const& pair : pairs) {
      Eigen::Vector3d const p = position(source, pair.index_query);
      auto const& surface = target[static_cast<std::size_t>(pair.index_match)];
      Eigen::Vector3d const normal = surface.getNormalVector3fMap().cast<double>();
      Vector6 slope;
      slope << (p - middle).cross(normal), normal;
      information += slope * slope.transpose();
      gradient += slope * normal.dot(position(target, pair.index_match) - p);
    }
    double const damping = kDamping * static_cast<double>(pairs.size());
    information.diagonal().head<3>().array() += damping * kLever_m * kLever_m;
    information.diagonal().tail<3>().array() += damping;
    Vector6 const motion = information.ldlt().solve(gradient);
    double const angle = motion.head<3>().norm();
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    if (angle > 0.0) {
      moved.linear() = Eigen::AngleAxisd(angle, motion.head<3>() / angle).toRotationMatrix();
    }
    moved.translation() = middle + motion.tail<3>() - moved.linear() * middle;
    step = moved.matrix().cast<float>();
  }

private:
  static Eigen::Vector3d position(NormalCloud const& points, pcl::index_t i) {
    return points[static_cast<std::size_t>(i)].getVector3fMap().cast<double>();
  }
};

}  // namespace

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
  icp.setTransformationEstimation(std::make_shared<DampedPlaneStep>());
  icp.setInputSource(source);
  icp.setSearchMethodTarget(target.tree, true);
  icp.setInputTarget(target.points);
  icp.setMaximumIterations(limits.iterations);
  icp.setMaxCorrespondenceDistance(limits.max_distance_m);
  icp.setTransformationEpsilon(1e-8);
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
