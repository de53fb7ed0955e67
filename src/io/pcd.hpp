#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/capture_config.hpp"
#include "core/cloud.hpp"
#include "core/error.hpp"
#include "core/frame.hpp"
#include "core/label.hpp"

namespace credo {

/// An organised cloud as a file holds it.
struct ColoredCloud {
  OrganizedCloud cloud_camera;
  /// Empty where the file has neither rgb nor rgba.
  Grid<Rgb> color;
};

/// Reads an organised PCD file (fields x y z, optionally rgb or rgba; ascii, binary or compressed)
/// and turns it into the camera's optical frame. Points that are NaN, 0 0 0, behind the camera or
/// beyond `max_depth_m` become invalid. Throws InputError: unreadable, cut short, unorganised,
/// without x y z.
ColoredCloud read_pcd(std::filesystem::path const& path, CloudAxes axes, double max_depth_m);

/// Points, and where their sensor stood (VIEWPOINT).
struct ViewedPoints {
  std::vector<Eigen::Vector3f> points;
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();
};

/// Reads a PCD file, organised or not (fields x y z), and turns it as read_pcd does. Points that
/// are not finite, and those at 0 0 0, are left out. Throws InputError: unreadable, cut short,
/// without x y z.
ViewedPoints read_pcd_points(std::filesystem::path const& path, CloudAxes axes);

/// The whole numbers of a PCD file's field `label`, by pixel; none where it has no such field.
/// Throws InputError for what read_pcd refuses, and for labels beyond 65535.
std::optional<LabelMap> read_pcd_labels(std::filesystem::path const& path);

}  // namespace credo
