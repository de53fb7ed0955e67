#include "io/pcd.hpp"

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "io/pcd_header.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

struct PclCloud {
  pcl::PCLPointCloud2 data;
  Eigen::Vector3f viewpoint;
};

PclCloud read_by_pcl(fs::path const& path, PcdHeader const& header) {
  // PCL writes its complaints to the terminal; ours are thrown.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation;
  int version = 0;
  try {
    if (pcl::PCDReader().read(path.string(), cloud, origin, orientation, version) >= 0 &&
        cloud.width == header.width && cloud.height == header.height &&
        cloud.data.size() == header.points * cloud.point_step) {
      return {std::move(cloud), origin.head<3>()};
    }
  } catch (std::exception const&) {
    // Told below, like the faults that PCL tells by its result.
  }
  throw InputError(path.string() + ": damaged PCD data");
}

/// Where a field of four bytes lies in a point. Colours come packed in a float or an integer.
std::optional<std::size_t> offset_of(pcl::PCLPointCloud2 const& cloud, std::string const& name,
                                     bool may_be_integer) {
  for (auto const& field : cloud.fields) {
    if (field.name == name && (field.datatype == pcl::PCLPointField::FLOAT32 ||
                               (may_be_integer && (field.datatype == pcl::PCLPointField::UINT32 ||
                                                   field.datatype == pcl::PCLPointField::INT32)))) {
      return field.offset;
    }
  }
  return std::nullopt;
}

template <typename T>
T value_at(pcl::PCLPointCloud2 const& cloud, std::size_t point, std::size_t offset) {
  T value;
  std::memcpy(&value, cloud.data.data() + point * cloud.point_step + offset, sizeof value);
  return value;
}

struct PointOffsets {
  std::size_t x = 0;
  std::size_t y = 0;
  std::size_t z = 0;
};

PointOffsets offsets_in(pcl::PCLPointCloud2 const& cloud, fs::path const& path) {
  auto const x = offset_of(cloud, "x", false);
  auto const y = offset_of(cloud, "y", false);
  auto const z = offset_of(cloud, "z", false);
  if (!x || !y || !z) {
    throw InputError(path.string() + ": needs float fields x y z");
  }
  return {*x, *y, *z};
}

Eigen::Vector3f point_at(pcl::PCLPointCloud2 const& cloud, std::size_t point,
                         PointOffsets const& offsets) {
  return {value_at<float>(cloud, point, offsets.x), value_at<float>(cloud, point, offsets.y),
          value_at<float>(cloud, point, offsets.z)};
}

float z_of(float z) {
  return z;
}
float z_of(Eigen::Vector3f const& point) {
  return point.z();
}

/// Whether y is up and z backward in a file, by its points or their z.
template <typename Points>
bool is_turned(Points const& points, CloudAxes axes) {
  if (axes != CloudAxes::kAuto) {
    return axes == CloudAxes::kYUpZBack;
  }
  std::size_t behind = 0;
  std::size_t ahead = 0;
  for (auto const& point : points) {
    behind += z_of(point) < 0 ? 1 : 0;
    ahead += z_of(point) > 0 ? 1 : 0;
  }
  return behind > ahead;
}

Eigen::Vector3f turned(Eigen::Vector3f const& point) {
  return {point.x(), -point.y(), -point.z()};
}

/// Turns the axes and makes invalid points NaN in all three coordinates.
void clean(OrganizedCloud& cloud, CloudAxes axes, double max_depth_m) {
  bool const turn = is_turned(cloud.z, axes);
  float const sign = turn ? -1.0F : 1.0F;
  auto const farthest = static_cast<float>(max_depth_m);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    float const z = sign * cloud.z[i];
    float const y = sign * cloud.y[i];
    bool const valid =
        z > 0.0F && z <= farthest && std::abs(y) < 1e6F && std::abs(cloud.x[i]) < 1e6F;
    cloud.set(i, valid ? Eigen::Vector3f(cloud.x[i], y, z) : Eigen::Vector3f::Constant(kNaN));
  }
}

}  // namespace

ColoredCloud read_pcd(fs::path const& path, CloudAxes axes, double max_depth_m) {
  PcdHeader const header = read_pcd_header(path);
  pcl::PCLPointCloud2 const data = read_by_pcl(path, header).data;
  PointOffsets const offsets = offsets_in(data, path);
  auto color = offset_of(data, "rgba", true);
  color = color ? color : offset_of(data, "rgb", true);
  ColoredCloud result;
  auto const width = static_cast<int>(header.width);
  auto const height = static_cast<int>(header.height);
  result.cloud_camera = OrganizedCloud(width, height);
  if (color) {
    result.color = Grid<Rgb>(width, height);
  }
  for (std::size_t i = 0; i < result.cloud_camera.size(); ++i) {
    result.cloud_camera.set(i, point_at(data, i, offsets));
    if (color) {
      auto const packed = value_at<std::uint32_t>(data, i, *color);
      result.color[i] = {static_cast<std::uint8_t>(packed >> 16U & 255U),
                         static_cast<std::uint8_t>(packed >> 8U & 255U),
                         static_cast<std::uint8_t>(packed & 255U)};
    }
  }
  clean(result.cloud_camera, axes, max_depth_m);
  return result;
}

ViewedPoints read_pcd_points(fs::path const& path, CloudAxes axes) {
  PclCloud const cloud = read_by_pcl(path, read_any_pcd_header(path));
  PointOffsets const offsets = offsets_in(cloud.data, path);
  std::size_t const count = cloud.data.data.size() / cloud.data.point_step;
  ViewedPoints viewed;
  viewed.viewpoint = cloud.viewpoint;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3f const point = point_at(cloud.data, i, offsets);
    if (point.allFinite() && !point.isZero(0.0F)) {
      viewed.points.push_back(point);
    }
  }
  if (is_turned(viewed.points, axes)) {
    viewed.viewpoint = turned(viewed.viewpoint);
    std::ranges::transform(viewed.points, viewed.points.begin(), turned);
  }
  return viewed;
}

std::optional<LabelMap> read_pcd_labels(fs::path const& path) {
  PcdHeader const header = read_pcd_header(path);
  pcl::PCLPointCloud2 const data = read_by_pcl(path, header).data;
  auto const offset = offset_of(data, "label", true);
  if (!offset) {
    return std::nullopt;
  }
  LabelMap labels(static_cast<int>(header.width), static_cast<int>(header.height));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    auto const label = value_at<std::uint32_t>(data, i, *offset);
    if (label > std::numeric_limits<LabelCode>::max()) {
      throw InputError(path.string() + ": label " + std::to_string(label) + " is beyond 65535");
    }
    labels[i] = static_cast<LabelCode>(label);
  }
  return labels;
}

}  // namespace credo
