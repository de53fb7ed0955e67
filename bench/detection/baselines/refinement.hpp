#pragma once

#include <pcl/search/kdtree.h>

#include "model_cloud.hpp"

namespace credo {

/// A cloud with the tree to search it by, built once.
struct SearchedCloud {
  NormalCloud::Ptr points;
  pcl::search::KdTree<pcl::PointNormal>::Ptr tree;
};

[[nodiscard]] SearchedCloud searched(NormalCloud::Ptr const& points);

struct IcpLimits {
  int iterations = 20;
  double max_distance_m = 0.02;
};

/// ICP as PCL runs it, with steps of point to plane: where `target` stands in the frame of
/// `source`, from a guess. The guess itself where it fails.
[[nodiscard]] Eigen::Isometry3f refined(NormalCloud::Ptr const& source, SearchedCloud const& target,
                                        Eigen::Isometry3f const& target_pose,
                                        IcpLimits const& limits);

}  // namespace credo
