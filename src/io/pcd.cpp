#include "io/pcd.hpp"

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <optional>
#include <string>

#include "io/pcd_header.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

pcl::PCLPointCloud2 read_by_pcl(fs::path const& path, PcdHeader const& header) {
  // PCL writes its complaints to the terminal; ours are thrown.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  try {
    if (pcl::PCDReader().read(path.string(), cloud, origin, orientation, version) >= 0 &&
        cloud.width == header.width && cloud.height == header.height &&
        cloud.data.size() == header.points * cloud.point_step) {
      return cloud;
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

bool mostly_behind(Grid<float> const& z) {
  std::size_t behind = 0;
  std::size_t ahead = 0;
  for (float const value : z) {
    behind += value < 0 ? 1 : 0;
    ahead += value > 0 ? 1 : 0;
  }
  return behind > ahead;
}

/// Turns the axes and makes invalid points NaN in all three coordinates.
void clean(OrganizedCloud& cloud, CloudAxes axes, double max_depth_m) {
  bool const turn =
      axes == CloudAxes::kYUpZBack || (axes == CloudAxes::kAuto && mostly_behind(cloud.z));
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
  pcl::PCLPointCloud2 const data = read_by_pcl(path, header);
  auto const x = offset_of(data, "x", false);
  auto const y = offset_of(data, "y", false);
  auto const z = offset_of(data, "z", false);
  if (!x || !y || !z) {
    throw InputError(path.string() + ": needs float fields x y z");
  }
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
    result.cloud_camera.set(i, {value_at<float>(data, i, *x), value_at<float>(data, i, *y),
                                value_at<float>(data, i, *z)});
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

std::optional<LabelMap> read_pcd_labels(fs::path const& path) {
  PcdHeader const header = read_pcd_header(path);
  pcl::PCLPointCloud2 const data = read_by_pcl(path, header);
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
