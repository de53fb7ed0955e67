#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace credo {

/// An edge of a model that is drawn where it is seen as a line: always where it is sharp, else
/// where one of its faces is turned towards the viewer and the other away. Model frame, metres.
struct OutlineEdge {
  Eigen::Vector3f begin = Eigen::Vector3f::Zero();
  Eigen::Vector3f end = Eigen::Vector3f::Zero();
  bool sharp = false;
  /// Outward, of the faces on either side; of any length.
  Eigen::Vector3f normal_left = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal_right = Eigen::Vector3f::Zero();
};

/// Of each model, by name.
using Outlines = std::map<std::string, std::vector<OutlineEdge>>;

}  // namespace credo
