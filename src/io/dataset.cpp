#include "io/dataset.hpp"

#include <optional>
#include <utility>

#include "core/error.hpp"
#include "io/checksums.hpp"
#include "io/dataset_listing.hpp"
#include "io/image.hpp"
#include "io/intrinsics.hpp"
#include "io/pcd.hpp"
#include "io/recording_file.hpp"
#include "io/trajectory.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kChecksum = "checksum";

/// A fault of one frame, on its way to becoming a FrameFailure.
struct FrameFault {
  std::string reason;
  std::string message;
};

/// Depth and colour of one frame, before it is known where the camera was.
struct Pictures {
  OrganizedCloud cloud_camera;
  Grid<Rgb> color;
};

FrameFault fault_of(ImageError const& error, char const* missing) {
  switch (error.fault()) {
    case ImageFault::kMissing:
      return {missing, error.what()};
    case ImageFault::kTruncated:
      return {"truncated_image", error.what()};
    case ImageFault::kUnreadable:
      break;
  }
  return {"unreadable_image", error.what()};
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

class DatasetSource : public FrameSource {
public:
  DatasetSource(fs::path folder, CaptureConfig const& capture, PoseConfig const& pose)
      : folder_(std::move(folder)),
        capture_(capture),
        pose_source_(pose.source),
        sums_(folder_ / kChecksumFile) {
    for (char const* name :
         {kRecordingFile, "camera-intrinsics.txt", "rgb.txt", "groundtruth.txt", "depth.txt"}) {
      sums_.check(folder_ / name);
    }
    listing_ = list_dataset(folder_, sums_);
    if (capture.depth_unit_m > 0) {
      listing_.depth_unit_m = capture.depth_unit_m;
    }
    if (pose.source == PoseSource::kFile) {
      if (pose.file.empty()) {
        throw InputError("pose.source is file, but pose.file names none");
      }
      trajectory_.emplace(pose.file);
    }
    first_ = load(0);
    auto const* failure = std::get_if<FrameFailure>(&first_);
    if (failure != nullptr && failure->reason != kChecksum) {
      throw InputError(failure->message);
    }
  }

  [[nodiscard]] std::size_t frame_count() const { return listing_.entries.size(); }
  [[nodiscard]] std::vector<std::string> const& warnings() const { return listing_.warnings; }

  SourceResult next() override {
    if (position_ == listing_.entries.size()) {
      return EndOfSource{};
    }
    std::size_t const index = position_++;
    return index == 0 ? std::move(first_) : load(index);
  }

private:
  SourceResult load(std::size_t index) {
    DatasetEntry const& entry = listing_.entries[index];
    FrameIndex const frame_index{static_cast<std::int64_t>(index)};
    try {
      Pictures pictures = entry.cloud.empty() ? read_images(entry) : read_cloud(entry);
      auto frame = std::make_shared<Frame>();
      frame->index = frame_index;
      frame->stamp_ns = entry.stamp_ns;
      frame->intrinsics = intrinsics_;
      frame->T_source_camera = pose_of(entry, frame_index);
      frame->cloud_camera = std::move(pictures.cloud_camera);
      frame->color = std::move(pictures.color);
      frame->color_registered = is_color_registered(capture_, listing_.color_registered);
      return FramePtr(std::move(frame));
    } catch (FrameFault const& fault) {
      return FrameFailure{frame_index, fault.reason, fault.message};
    }
  }

  /// The first frame settles size and intrinsics; the others must be like it.
  void check_size(int width, int height, fs::path const& file) {
    if (width_ == 0) {
      intrinsics_ = find_intrinsics(folder_, capture_, width, height, listing_.warnings);
      width_ = width;
      height_ = height;
    } else if (width != width_ || height != height_) {
      throw FrameFault{"wrong_size", file.string() + ": is " + size_text(width, height) +
                                         ", the first frame is " + size_text(width_, height_)};
    }
  }

  Pictures read_images(DatasetEntry const& entry) {
    if (entry.depth.empty()) {
      throw FrameFault{"missing_depth", entry.color.string() + ": colour without depth"};
    }
    if (entry.color.empty() && !listing_.color_may_lack) {
      throw FrameFault{"missing_color", entry.depth.string() + ": depth without colour"};
    }
    Grid<float> depth_m = read_depth(entry.depth);
    check_size(depth_m.width(), depth_m.height(), entry.depth);
    Pictures pictures;
    if (!entry.color.empty()) {
      pictures.color = read_frame_color(entry.color);
    }
    if (!entry.color.empty() && !pictures.color.same_size(depth_m)) {
      throw FrameFault{"wrong_size",
                       entry.color.string() + ": is " +
                           size_text(pictures.color.width(), pictures.color.height()) +
                           ", its depth " + size_text(depth_m.width(), depth_m.height())};
    }
    pictures.cloud_camera = cloud_from_depth(std::move(depth_m), intrinsics_);
    return pictures;
  }

  [[nodiscard]] Grid<float> read_depth(fs::path const& path) const {
    try {
      Grid<std::uint16_t> const counts = decode_png16(verified_bytes(path), path);
      auto const unit_m = static_cast<float>(listing_.depth_unit_m);
      auto const farthest_m = static_cast<float>(capture_.max_depth_m);
      Grid<float> depth_m(counts.width(), counts.height());
      for (std::size_t i = 0; i < counts.size(); ++i) {
        float const z = static_cast<float>(counts[i]) * unit_m;
        depth_m[i] = counts[i] != 65535 && z <= farthest_m ? z : 0.0F;
      }
      return depth_m;
    } catch (ImageError const& error) {
      throw fault_of(error, "missing_depth");
    }
  }

  [[nodiscard]] Grid<Rgb> read_frame_color(fs::path const& path) const {
    try {
      return decode_color(verified_bytes(path), path);
    } catch (ImageError const& error) {
      throw fault_of(error, "missing_color");
    }
  }

  /// A file that others read.
  void verify(fs::path const& path) const {
    if (sums_.lists(path)) {
      try {
        static_cast<void>(verified_bytes(path));
      } catch (ImageError const& error) {
        throw FrameFault{kChecksum, error.what()};
      }
    }
  }

  [[nodiscard]] std::vector<unsigned char> verified_bytes(fs::path const& path) const {
    if (sums_.lists(path) && !fs::exists(path)) {
      throw FrameFault{kChecksum, path.string() + ": is listed in " + kChecksumFile +
                                      ", but not there; restore it from a copy"};
    }
    std::vector<unsigned char> bytes = read_bytes(path);
    if (sums_.of(path, bytes) == Checksums::Verdict::kDamaged) {
      throw FrameFault{kChecksum, path.string() +
                                      ": is damaged: it does not match its checksum in " +
                                      kChecksumFile + "; restore it from a copy"};
    }
    return bytes;
  }

  Pictures read_cloud(DatasetEntry const& entry) {
    verify(entry.cloud);
    try {
      ColoredCloud read = read_pcd(entry.cloud, capture_.axes, capture_.max_depth_m);
      check_size(read.cloud_camera.width(), read.cloud_camera.height(), entry.cloud);
      return {std::move(read.cloud_camera), std::move(read.color)};
    } catch (InputError const& error) {
      throw FrameFault{"bad_cloud", error.what()};
    }
  }

  [[nodiscard]] Se3 pose_of(DatasetEntry const& entry, FrameIndex index) const {
    if (pose_source_ == PoseSource::kFixed) {
      return {};
    }
    std::optional<Se3> pose = entry.pose;
    if (pose_source_ == PoseSource::kFile) {
      pose = trajectory_->at(index, entry.stamp_ns);
    } else if (!listing_.has_poses) {
      return {};
    } else if (!entry.pose_file.empty()) {
      verify(entry.pose_file);
      try {
        return read_pose(entry.pose_file);
      } catch (InputError const& error) {
        throw FrameFault{"bad_pose", error.what()};
      }
    }
    if (!pose) {
      throw FrameFault{"missing_pose", folder_.string() + ": no pose for frame " +
                                           std::to_string(number(index)) +
                                           "; pose.source=fixed runs without poses"};
    }
    return *pose;
  }

  fs::path folder_;
  CaptureConfig capture_;
  PoseSource pose_source_;
  Checksums sums_;
  DatasetListing listing_;
  std::optional<Trajectory> trajectory_;
  CameraIntrinsics intrinsics_;
  int width_ = 0;
  int height_ = 0;
  std::size_t position_ = 0;
  SourceResult first_;
};

}  // namespace

OpenedSource open_dataset(fs::path const& folder, CaptureConfig const& capture,
                          PoseConfig const& pose) {
  OpenedSource opened;
  auto source = std::make_unique<DatasetSource>(folder, capture, pose);
  opened.warnings = source->warnings();
  opened.frame_count = source->frame_count();
  opened.source = std::move(source);
  return opened;
}

}  // namespace credo
