#include "io/recording_writer.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/checksums.hpp"
#include "io/image.hpp"
#include "io/sha256.hpp"
#include "io/tum_text.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr double kMostCounts = 65534.0;  // 65535 reads as invalid
constexpr double kRoundedUnitM = 0.0002;

struct Counts {
  Grid<std::uint16_t> image;
  /// They read back to the same bits.
  bool exact = true;
};

Counts counts_of(Grid<float> const& depth_m, double unit_m) {
  Counts counts{Grid<std::uint16_t>(depth_m.width(), depth_m.height()), true};
  auto const unit = static_cast<float>(unit_m);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    float const z_m = depth_m[i];
    if (!(z_m > 0.0F)) {
      continue;
    }
    double const count = std::round(static_cast<double>(z_m) / unit_m);
    bool const held = count >= 1.0 && count <= kMostCounts;
    counts.image[i] = held ? static_cast<std::uint16_t>(count) : std::uint16_t{0};
    counts.exact = counts.exact && held && static_cast<float>(counts.image[i]) * unit == z_m;
  }
  return counts;
}

double unit_of(Grid<float> const& depth_m, double wanted_m) {
  for (double const unit_m : {wanted_m, 0.001, 0.0001, kRoundedUnitM}) {
    if (unit_m > 0.0 && counts_of(depth_m, unit_m).exact) {
      return unit_m;
    }
  }
  return kRoundedUnitM;
}

}  // namespace

RecordingWriter::RecordingWriter(fs::path folder, double depth_unit_m)
    : folder_(std::move(folder)), wanted_unit_m_(depth_unit_m) {
  std::error_code error;
  if (folder_.has_parent_path()) {
    fs::create_directories(folder_.parent_path(), error);
  }
  if (!error && !fs::create_directory(folder_, error) && !error) {
    throw InputError(folder_.string() + ": is there already; name a new folder to record into");
  }
  for (char const* inner : {"depth", "rgb"}) {
    if (!error) {
      fs::create_directory(folder_ / inner, error);
    }
  }
  if (error) {
    throw InputError(folder_.string() + ": cannot be made: " + error.message());
  }
}

std::optional<std::string> RecordingWriter::refusal(Frame const& frame) const {
  if (!lists_) {
    return std::nullopt;
  }
  if (frame.cloud_camera.width() != width_ || frame.cloud_camera.height() != height_ ||
      frame.intrinsics != intrinsics_) {
    return "frame " + std::to_string(number(frame.index)) +
           ": has another size or field of view than the first: record it into a folder of its own";
  }
  if (frame.stamp_ns <= last_stamp_ns_) {
    return "frame " + std::to_string(number(frame.index)) +
           ": its time is not after the one before";
  }
  return std::nullopt;
}

void RecordingWriter::begin(Frame const& first) {
  intrinsics_ = first.intrinsics;
  width_ = first.cloud_camera.width();
  height_ = first.cloud_camera.height();
  info_ = {unit_of(first.cloud_camera.z, wanted_unit_m_), first.color_registered};
  write_recording_info(folder_, info_);
  AppendedFile(folder_ / "camera-intrinsics.txt").append(intrinsics_text(intrinsics_));
  lists_.emplace(Lists{AppendedFile(folder_ / kChecksumFile), AppendedFile(folder_ / "depth.txt"),
                       AppendedFile(folder_ / "rgb.txt"),
                       AppendedFile(folder_ / "groundtruth.txt")});
}

void RecordingWriter::write(Frame const& frame) {
  if (refusal(frame)) {
    throw std::logic_error("RecordingWriter: " + *refusal(frame));
  }
  if (!lists_) {
    begin(frame);
  }
  Counts const counts = counts_of(frame.cloud_camera.z, info_.depth_unit_m);
  EncodedPng depth;
  EncodedPng color;
  // The two images of a sensor at 30 Hz keep one processor busy.
  tbb::parallel_invoke([&] { depth = encode_png16(counts.image); },
                       [&] {
                         if (!frame.color.empty()) {
                           color = encode_png_rgb(frame.color);
                         }
                       });
  std::string const stamp = tum_stamp(frame.stamp_ns);
  std::string const file = tum_image_name(frame.index);
  std::string const depth_name = write_image("depth", file, depth);
  if (!color.empty()) {
    lists_->color.append(stamp + " " + write_image("rgb", file, color));
  }
  lists_->poses.append(tum_pose(frame.stamp_ns, frame.T_source_camera));
  lists_->depth.append(stamp + " " + depth_name);
  color_registered_ = color_registered_ && (color.empty() || frame.color_registered);
  last_stamp_ns_ = frame.stamp_ns;
  ++frames_;
  rounded_ += counts.exact ? 0 : 1;
}

std::string RecordingWriter::write_image(std::string const& folder, std::string const& file,
                                         EncodedPng const& png) {
  std::string name = folder + "/" + file;
  try {
    write_bytes(folder_ / name, png);
  } catch (InputError const&) {
    std::error_code ignored;
    fs::remove(folder_ / name, ignored);
    throw;
  }
  lists_->sums.append(checksum_line(sha256_of(png), name));
  bytes_ += png.size();
  return name;
}

void RecordingWriter::finish() {
  if (!lists_ || frames_ == 0) {
    fs::remove_all(folder_);
    return;
  }
  if (info_.color_registered && !color_registered_) {
    info_.color_registered = false;
    write_recording_info(folder_, info_);
  }
  for (char const* name :
       {kRecordingFile, "camera-intrinsics.txt", "rgb.txt", "groundtruth.txt", "depth.txt"}) {
    lists_->sums.append(checksum_line(sha256_of_file(folder_ / name), name));
  }
  lists_.reset();
}

}  // namespace credo
