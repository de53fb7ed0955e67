#include "io/pcd.hpp"

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace credo {
namespace {

enum class DataKind : std::uint8_t { kAscii = 0, kBinary = 1, kCompressed = 2 };

struct Header {
  pcl::PCLPointCloud2 cloud;
  DataKind kind = DataKind::kAscii;
  std::size_t data_start = 0;
};

/// PCL's reader divides by zero where a header lacks its sizes, so those are looked for first.
void check_header_words(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  int found = 0;
  // Far more lines than any header has.
  for (int i = 0; i < 64 && std::getline(file, line); ++i) {
    std::istringstream words(line);
    std::string key;
    std::int64_t value = 0;
    words >> key;
    if (key == "FIELDS") {
      ++found;
    } else if (key == "WIDTH" || key == "HEIGHT") {
      found += words >> value && value > 0 && value < 100'000 ? 1 : 0;
    } else if (key == "DATA") {
      ++found;
      break;
    }
  }
  if (found != 4) {
    throw InputError(path.string() +
                     ": not a PCD file: its header needs FIELDS, WIDTH, HEIGHT and DATA");
  }
}

Header read_header(pcl::PCDReader& reader, std::filesystem::path const& path) {
  check_header_words(path);
  Header header;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  int kind = 0;
  unsigned int data_start = 0;
  if (reader.readHeader(path.string(), header.cloud, origin, orientation, version, kind,
                        data_start) < 0) {
    throw InputError(path.string() + ": not a PCD file, or its header is damaged");
  }
  header.kind = static_cast<DataKind>(kind);
  header.data_start = data_start;
  return header;
}

/// The reader trusts the header; a file cut by a full disk must be told before it is read.
void check_complete(Header const& header, std::filesystem::path const& path) {
  auto const size = std::filesystem::file_size(path);
  std::size_t const points =
      static_cast<std::size_t>(header.cloud.width) * static_cast<std::size_t>(header.cloud.height);
  std::size_t needed = header.data_start;
  if (header.kind == DataKind::kBinary) {
    needed += points * header.cloud.point_step;
  } else if (header.kind == DataKind::kCompressed) {
    std::array<std::uint32_t, 2> lengths{};  // compressed, uncompressed
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(header.data_start));
    file.read(reinterpret_cast<char*>(lengths.data()), sizeof lengths);
    needed += sizeof lengths + (file ? lengths[0] : 0);
  }
  if (size < needed || size == header.data_start) {
    throw InputError(path.string() + ": cut short, has " + std::to_string(size) + " of " +
                     std::to_string(needed) + " bytes");
  }
}

std::optional<std::size_t> offset_of(pcl::PCLPointCloud2 const& cloud, std::string const& name,
                                     bool needs_float) {
  for (auto const& field : cloud.fields) {
    if (field.name == name && (!needs_float || field.datatype == pcl::PCLPointField::FLOAT32)) {
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

ColoredCloud read_pcd(std::filesystem::path const& path, CloudAxes axes, double max_depth_m) {
  // PCL writes its complaints to the terminal; ours are thrown.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  if (!std::filesystem::exists(path)) {
    throw InputError(path.string() + ": no such file");
  }
  pcl::PCDReader reader;
  check_complete(read_header(reader, path), path);
  pcl::PCLPointCloud2 data;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  if (reader.read(path.string(), data, origin, orientation, version) < 0) {
    throw InputError(path.string() + ": damaged PCD data");
  }
  if (data.height < 2 || data.width < 2) {
    throw InputError(path.string() + ": not organised (" + std::to_string(data.width) + "x" +
                     std::to_string(data.height) + "): an image of points is needed");
  }
  auto const x = offset_of(data, "x", true);
  auto const y = offset_of(data, "y", true);
  auto const z = offset_of(data, "z", true);
  if (!x || !y || !z) {
    throw InputError(path.string() + ": needs float fields x y z");
  }
  auto color = offset_of(data, "rgba", false);
  color = color ? color : offset_of(data, "rgb", false);
  ColoredCloud result;
  result.cloud_camera = OrganizedCloud(static_cast<int>(data.width), static_cast<int>(data.height));
  if (color) {
    result.color = Grid<Rgb>(static_cast<int>(data.width), static_cast<int>(data.height));
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

}  // namespace credo
