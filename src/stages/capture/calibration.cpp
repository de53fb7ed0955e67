#include "stages/capture/calibration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

#include "stages/capture/coarse_cloud.hpp"
#include "stages/capture/floor_search.hpp"
#include "stages/capture/level.hpp"
#include "stages/capture/wall_search.hpp"

namespace credo {
namespace {

// As of LevelWatch: beyond these a camera has moved.
constexpr double kMostTilt_rad = 2.0 * std::numbers::pi / 180.0;
constexpr double kMostRise_m = 0.04;

constexpr std::array kStandMembers = {&CameraStand::pitch_rad, &CameraStand::roll_rad,
                                      &CameraStand::height_m,  &CameraStand::yaw_rad,
                                      &CameraStand::x_m,       &CameraStand::y_m};

double angle_between_rad(Eigen::Vector3d const& a, Eigen::Vector3d const& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Component by component.
Plane median_of(std::vector<Plane> const& planes) {
  auto const median = [&](auto const& component) {
    std::vector<double> values;
    std::ranges::transform(planes, std::back_inserter(values), component);
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  };
  Eigen::Vector3d const normal(median([](Plane const& p) { return p.normal.x(); }),
                               median([](Plane const& p) { return p.normal.y(); }),
                               median([](Plane const& p) { return p.normal.z(); }));
  return {normal.normalized(), median([](Plane const& p) { return p.offset_m; })};
}

bool agree(Plane const& a, Plane const& b) {
  return angle_between_rad(a.normal, b.normal) <= kMostTilt_rad &&
         std::abs(a.offset_m - b.offset_m) <= kMostRise_m;
}

/// b - a, whatever turn it takes.
double angle_from_to_rad(double a, double b) {
  return std::remainder(b - a, 2.0 * std::numbers::pi);
}

CameraStand difference(CameraStand const& from, CameraStand const& to) {
  return {angle_from_to_rad(from.pitch_rad, to.pitch_rad),
          angle_from_to_rad(from.roll_rad, to.roll_rad),
          to.height_m - from.height_m,
          angle_from_to_rad(from.yaw_rad, to.yaw_rad),
          to.x_m - from.x_m,
          to.y_m - from.y_m};
}

std::optional<CameraStand> spread_of(std::vector<CameraStand> const& stands) {
  if (stands.size() < 2) {
    return std::nullopt;
  }
  CameraStand spread;
  for (auto const member : kStandMembers) {
    double sum = 0.0;
    double squares = 0.0;
    for (CameraStand const& stand : stands) {
      double const value = difference(stands.front(), stand).*member;
      sum += value;
      squares += value * value;
    }
    auto const count = static_cast<double>(stands.size());
    spread.*member = std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1.0)));
  }
  return spread;
}

std::vector<CameraStand> stands_by_frame(StillSurface const& floor,
                                         std::optional<StillSurface> const& wall) {
  std::vector<CameraStand> stands;
  for (std::size_t f = 0; f < floor.by_frame.size(); ++f) {
    if (floor.by_frame[f] && (!wall || wall->by_frame[f])) {
      stands.push_back(stand_of(*floor.by_frame[f], wall ? wall->by_frame[f] : std::nullopt));
    }
  }
  return stands;
}

/// False where there is no wall.
bool add_wall(std::span<PlaneSearchPoints const> frames, Calibration& calibration) {
  std::optional<Plane> const guess = find_wall(frames, calibration.floor.plane);
  if (!guess) {
    return false;
  }
  Eigen::Vector3d const up = calibration.floor.plane.normal;
  calibration.wall = fit_still_surface(
      frames, *guess, [&up](RayPlaneFit const& sums) { return sums.plane_along(up); });
  std::optional<StillSurface> const freely =
      fit_still_surface(frames, *guess, [](RayPlaneFit const& sums) { return sums.plane(); });
  if (freely) {
    calibration.wall_lean_rad = std::asin(std::clamp(freely->plane.normal.dot(up), -1.0, 1.0));
  }
  return calibration.wall.has_value();
}

}  // namespace

CalibrationLook look_for_floor(OrganizedCloud const& cloud_camera) {
  CoarseCloud coarse = coarse_cloud(cloud_camera);
  std::optional<Plane> const floor = find_floor(coarse);
  return {std::move(coarse.search), floor};
}

CameraStand stand_of(Plane const& floor, std::optional<Plane> const& wall) {
  CameraStand camera;
  Eigen::Vector3d const& up = floor.normal;
  camera.pitch_rad = std::asin(std::clamp(-up.z(), -1.0, 1.0));
  camera.roll_rad = std::atan2(-up.x(), -up.y());
  camera.height_m = -floor.offset_m;
  if (wall) {
    Eigen::Vector3d const out = given_camera(given_pose(camera)).rotation() * wall->normal;
    camera.yaw_rad = -std::atan2(out.y(), out.x());
    camera.x_m = -wall->offset_m;
  }
  return camera;
}

PoseConfig given_pose(CameraStand const& camera) {
  PoseConfig pose;
  pose.level = LevelMode::kGiven;
  pose.camera_pitch_rad = camera.pitch_rad;
  pose.camera_roll_rad = camera.roll_rad;
  pose.camera_height_m = camera.height_m;
  pose.camera_yaw_rad = camera.yaw_rad;
  pose.camera_x_m = camera.x_m;
  pose.camera_y_m = camera.y_m;
  return pose;
}

CalibrationResult calibrate(std::vector<CalibrationLook> looks, bool with_wall) {
  CalibrationResult result;
  std::vector<Plane> floors;
  for (CalibrationLook const& look : looks) {
    if (look.floor_camera) {
      floors.push_back(*look.floor_camera);
    }
  }
  result.frames_with_floor = static_cast<int>(floors.size());
  if (floors.empty() || 2 * floors.size() < looks.size()) {
    return result;
  }
  Plane const middle = median_of(floors);
  std::vector<PlaneSearchPoints> frames;
  for (CalibrationLook& look : looks) {
    if (look.floor_camera && agree(middle, *look.floor_camera)) {
      frames.push_back(std::move(look.points_camera));
    }
  }
  result.frames_agreeing = static_cast<int>(frames.size());
  result.fault = CalibrationFault::kFloorMoves;
  if (frames.empty() || 2 * frames.size() < looks.size()) {
    return result;
  }
  std::optional<StillSurface> floor =
      fit_still_surface(frames, middle, [](RayPlaneFit const& sums) { return sums.plane(); });
  if (!floor) {
    result.fault = CalibrationFault::kNoFloor;
    return result;
  }
  Calibration calibration;
  calibration.floor = std::move(*floor);
  result.fault = CalibrationFault::kNoWall;
  if (with_wall && !add_wall(frames, calibration)) {
    return result;
  }
  calibration.camera =
      stand_of(calibration.floor.plane,
               calibration.wall ? std::optional(calibration.wall->plane) : std::nullopt);
  calibration.spread = spread_of(stands_by_frame(calibration.floor, calibration.wall));
  result.calibration = std::move(calibration);
  return result;
}

LabelMap surfaces_in(OrganizedCloud const& cloud_camera, Calibration const& calibration) {
  LabelMap labels(cloud_camera.width(), cloud_camera.height(), kNoDepth);
  auto const lies_on = [](StillSurface const& surface, Eigen::Vector3d const& point) {
    return std::abs(inverse_depth_error_per_m(surface.plane, point)) <= surface.gate_per_m &&
           std::abs(surface.plane.signed_distance_m(point)) <=
               static_cast<double>(noise_tolerance_m(static_cast<float>(point.z())));
  };
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!cloud_camera.valid(i)) {
      continue;
    }
    Eigen::Vector3d const point = cloud_camera.at(i).cast<double>();
    labels[i] = kUnassigned;
    if (lies_on(calibration.floor, point)) {
      labels[i] = kFloor;
    } else if (calibration.wall && lies_on(*calibration.wall, point)) {
      labels[i] = kFirstWall;
    }
  }
  return labels;
}

}  // namespace credo
