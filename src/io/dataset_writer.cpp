#include "io/dataset_writer.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "core/error.hpp"
#include "io/image.hpp"
#include "io/tum_text.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr double kCountsPerMetre = 5000.0;
constexpr double kMaxCount = 65534.0;

Grid<std::uint16_t> counts_of(Grid<float> const& depth_m) {
  Grid<std::uint16_t> counts(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    double const count = std::round(static_cast<double>(depth_m[i]) * kCountsPerMetre);
    counts[i] = count > 0 && count <= kMaxCount ? static_cast<std::uint16_t>(count) : 0;
  }
  return counts;
}

std::ofstream opened(fs::path const& path) {
  std::ofstream file(path, std::ios::binary);
  if (!file) {
    throw InputError(path.string() + ": cannot be written");
  }
  return file;
}

}  // namespace

DatasetWriter::DatasetWriter(fs::path folder) : folder_(std::move(folder)) {
  if (fs::exists(folder_ / "depth.txt")) {
    throw InputError(folder_.string() + ": holds a dataset already; name another folder");
  }
  std::error_code error;
  for (char const* inner : {"depth", "rgb", "truth"}) {
    fs::create_directories(folder_ / inner, error);
    if (error) {
      throw InputError((folder_ / inner).string() + ": cannot be made: " + error.message());
    }
  }
  depth_ = opened(folder_ / "depth.txt");
  color_ = opened(folder_ / "rgb.txt");
  poses_ = opened(folder_ / "groundtruth.txt");
  truth_ = opened(folder_ / "truth.jsonl");
}

void DatasetWriter::append(std::ofstream& list, std::string const& name,
                           std::string const& line) const {
  list << line << '\n' << std::flush;
  if (!list) {
    throw InputError((folder_ / name).string() + ": cannot be written: is the disk full?");
  }
}

void DatasetWriter::write(Frame const& frame) {
  if (!fs::exists(folder_ / "camera-intrinsics.txt")) {
    opened(folder_ / "camera-intrinsics.txt") << intrinsics_text(frame.intrinsics);
  }
  std::string const file = tum_image_name(frame.index);
  std::string const stamp = tum_stamp(frame.stamp_ns);
  write_png16(folder_ / "depth" / file, counts_of(frame.cloud_camera.z));
  write_png_rgb(folder_ / "rgb" / file, frame.color);
  append(depth_, "depth.txt", stamp + " depth/" + file);
  append(color_, "rgb.txt", stamp + " rgb/" + file);
  append(poses_, "groundtruth.txt", tum_pose(frame.stamp_ns, frame.T_source_camera));
}

void DatasetWriter::write_truth(FrameIndex frame, std::string const& json_line,
                                LabelMap const& labels) {
  write_png16(folder_ / "truth" / tum_image_name(frame), labels);
  append(truth_, "truth.jsonl", json_line);
}

}  // namespace credo
