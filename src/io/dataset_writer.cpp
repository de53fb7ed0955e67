#include "io/dataset_writer.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "core/error.hpp"
#include "io/image.hpp"

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

template <typename... Values>
std::string text(char const* format, Values... values) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(), format, values...);  // NOLINT(*-vararg)
  return line.data();
}

std::string file_name(FrameIndex frame) {
  return text("%06lld.png", static_cast<long long>(number(frame)));
}

std::string stamp_text(std::int64_t stamp_ns) {
  return text("%lld.%09lld", static_cast<long long>(stamp_ns / 1'000'000'000),
              static_cast<long long>(stamp_ns % 1'000'000'000));
}

std::ofstream opened(fs::path const& path) {
  std::ofstream file(path, std::ios::binary);
  if (!file) {
    throw InputError(path.string() + ": cannot be written");
  }
  return file;
}

void write_intrinsics(fs::path const& path, CameraIntrinsics const& k) {
  std::ofstream file = opened(path);
  file << text("%.17g 0 %.17g\n0 %.17g %.17g\n0 0 1\n", k.fx_px, k.cx_px, k.fy_px, k.cy_px);
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
    write_intrinsics(folder_ / "camera-intrinsics.txt", frame.intrinsics);
  }
  std::string const file = file_name(frame.index);
  std::string const stamp = stamp_text(frame.stamp_ns);
  write_png16(folder_ / "depth" / file, counts_of(frame.cloud_camera.z));
  write_png_rgb(folder_ / "rgb" / file, frame.color);
  append(depth_, "depth.txt", stamp + " depth/" + file);
  append(color_, "rgb.txt", stamp + " rgb/" + file);
  Eigen::Vector3d const& t = frame.T_source_camera.translation();
  Eigen::Quaterniond const& q = frame.T_source_camera.rotation();
  append(poses_, "groundtruth.txt",
         stamp + text(" %.17g %.17g %.17g %.17g %.17g %.17g %.17g", t.x(), t.y(), t.z(), q.x(),
                      q.y(), q.z(), q.w()));
}

void DatasetWriter::write_truth(FrameIndex frame, std::string const& json_line,
                                LabelMap const& labels) {
  write_png16(folder_ / "truth" / file_name(frame), labels);
  append(truth_, "truth.jsonl", json_line);
}

}  // namespace credo
