#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vector>

namespace credo {

/// Points as the verification takes them (their intensity says nothing).
using VerifiedCloud = pcl::PointCloud<pcl::PointXYZI>;

/// Of PCL's GlobalHypothesesVerification.
struct VerificationSettings {
  float resolution_m = 0.005F;
  /// A point of a hypothesis explains the scene's points within so much,
  float inlier_m = 0.01F;
  /// and is hidden where it is behind the depth seen by so much.
  float occlusion_m = 0.015F;
  /// Weights of the visible points that explain nothing, and of the scene's points around the
  /// explained ones, on the same smooth surface, that are left unexplained.
  float outlier_weight = 1.0F;
  float clutter_radius_m = 0.03F;
  float clutter_weight = 1.0F;
};

/// Which hypotheses (models' clouds in the camera frame) stand when all are judged together:
/// Aldoma et al. 2012 as PCL has it. `things` is the part of the scene that they must explain,
/// `whole` the organised cloud of the frame.
[[nodiscard]] std::vector<bool> verified(VerifiedCloud::Ptr const& things,
                                         VerifiedCloud::Ptr const& whole,
                                         std::vector<VerifiedCloud::ConstPtr> hypotheses,
                                         VerificationSettings const& settings);

}  // namespace credo
