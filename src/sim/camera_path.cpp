#include "sim/camera_path.hpp"

#include <algorithm>
#include <cmath>

namespace credo {
namespace {

Eigen::Vector3d vector_of(std::vector<double> const& v) {
  return {v[0], v[1], v[2]};
}

using Member = std::vector<double> SceneWaypoint::*;

/// Value at `share` of the way from waypoint i to i + 1; tangents allow for uneven times.
Eigen::Vector3d spline(std::vector<SceneWaypoint> const& path, Member member, std::size_t i,
                       double share) {
  auto const value = [&](std::size_t k) { return vector_of(path[k].*member); };
  auto const tangent = [&](std::size_t k) -> Eigen::Vector3d {
    if (k == 0 || k + 1 == path.size()) {
      return Eigen::Vector3d::Zero();
    }
    return (value(k + 1) - value(k - 1)) / (path[k + 1].time_s - path[k - 1].time_s);
  };
  double const span_s = path[i + 1].time_s - path[i].time_s;
  double const s2 = share * share;
  double const s3 = s2 * share;
  return (2 * s3 - 3 * s2 + 1) * value(i) + (s3 - 2 * s2 + share) * span_s * tangent(i) +
         (3 * s2 - 2 * s3) * value(i + 1) + (s3 - s2) * span_s * tangent(i + 1);
}

}  // namespace

Se3 camera_pose(std::vector<SceneWaypoint> const& path, double time_s) {
  double const t = std::clamp(time_s, path.front().time_s, path.back().time_s);
  Eigen::Vector3d eye = vector_of(path.front().position_m);
  Eigen::Vector3d aim = vector_of(path.front().look_at_m);
  if (path.size() > 1) {
    std::size_t i = 0;
    while (i + 2 < path.size() && t > path[i + 1].time_s) {
      ++i;
    }
    double const share = (t - path[i].time_s) / (path[i + 1].time_s - path[i].time_s);
    eye = spline(path, &SceneWaypoint::position_m, i, share);
    aim = spline(path, &SceneWaypoint::look_at_m, i, share);
  }
  Eigen::Vector3d const forward = (aim - eye).normalized();
  // Looking straight up or down leaves the roll open: x of the world is then up in the picture.
  Eigen::Vector3d const up =
      std::abs(forward.z()) > 0.9999 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R;
  R.col(0) = forward.cross(up).normalized();
  R.col(1) = forward.cross(R.col(0));
  R.col(2) = forward;
  return {Eigen::Quaterniond(R), eye};
}

}  // namespace credo
