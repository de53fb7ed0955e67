#include "openni/oni_source.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/image.hpp"
#include "io/trajectory.hpp"
#include "openni/oni_checksum.hpp"
#include "openni/oni_codec.hpp"
#include "openni/oni_records.hpp"
#include "openni/sensor_image.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

constexpr std::uint64_t kRgbPixels = 1;

/// A fault of one frame, on its way to becoming a FrameFailure.
struct Fault {
  std::string reason;
  std::string message;
};

bool reads_color(OniStream const& stream) {
  return stream.codec == "JPEG" || (stream.codec == "NONE" && stream.pixel_format == kRgbPixels);
}

std::string size_text(OniStream const& stream) {
  return std::to_string(stream.width) + "x" + std::to_string(stream.height);
}

/// Half the usual time between two images.
std::int64_t pairing_window_ns(std::vector<OniImage> const& images) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (!images[i].lost && !images[i - 1].lost) {
      steps.push_back(images[i].stamp_ns - images[i - 1].stamp_ns);
    }
  }
  constexpr std::int64_t kUsual_ns = 1'000'000'000 / 30;
  if (steps.empty()) {
    return kUsual_ns / 2;
  }
  auto const middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  // A step that is odd in nanoseconds must not leave its middle unpaired.
  return std::max<std::int64_t>(*middle / 2 + 1, 0);
}

class OniSource : public FrameSource {
public:
  OniSource(fs::path path, CaptureConfig const& capture, PoseConfig const& pose)
      : path_(std::move(path)),
        capture_(capture),
        index_(index_oni(path_)),
        file_(path_, std::ios::binary) {
    OniStream const& depth = index_.depth;
    if (depth.codec != "16zT" && depth.codec != "16zP" && depth.codec != "NONE") {
      throw InputError(path_.string() + ": depth is packed as " + depth.codec +
                       ", which is not read; 16z, 16zT and NONE are");
    }
    intrinsics_ = intrinsics_of(
        {depth.width, depth.height, depth.horizontal_fov_rad, depth.vertical_fov_rad}, capture);
    if (pose.source == PoseSource::kFile) {
      if (pose.file.empty()) {
        throw InputError("pose.source is file, but pose.file names none");
      }
      trajectory_.emplace(pose.file);
    }
    prepare_color();
  }

  [[nodiscard]] std::size_t frame_count() const { return index_.depth.images.size(); }
  [[nodiscard]] std::vector<std::string> const& warnings() const { return index_.warnings; }

  SourceResult next() override {
    if (position_ == frame_count()) {
      return EndOfSource{};
    }
    OniImage const& image = index_.depth.images[position_];
    FrameIndex const index{static_cast<std::int64_t>(position_++)};
    try {
      auto frame = std::make_shared<Frame>();
      frame->index = index;
      frame->stamp_ns = image.stamp_ns;
      frame->intrinsics = intrinsics_;
      frame->cloud_camera = cloud_from_depth(depth(image), intrinsics_);
      frame->color = color_near(image.stamp_ns);
      frame->color_registered = is_color_registered(capture_, false);
      frame->T_source_camera = pose_of(index, image.stamp_ns);
      return FramePtr(std::move(frame));
    } catch (Fault const& fault) {
      return FrameFailure{index, fault.reason, fault.message};
    } catch (ImageError const& error) {
      return FrameFailure{index, "unreadable_image", error.what()};
    }
  }

private:
  void prepare_color() {
    if (!index_.color) {
      return;
    }
    OniStream& color = *index_.color;
    if (!reads_color(color)) {
      index_.warnings.push_back(path_.string() + ": runs without colour, which is packed as " +
                                color.codec + "; JPEG and RGB are read");
      index_.color.reset();
    } else if (color.width != index_.depth.width || color.height != index_.depth.height) {
      index_.warnings.push_back(path_.string() + ": runs without colour, which is " +
                                size_text(color) + " where depth is " + size_text(index_.depth));
      index_.color.reset();
    } else {
      std::erase_if(color.images, [](OniImage const& image) { return image.lost; });
      std::ranges::stable_sort(color.images, {}, &OniImage::stamp_ns);
      window_ns_ = pairing_window_ns(index_.depth.images);
    }
  }

  Bytes read(OniImage const& image) {
    Bytes bytes(image.size_bytes);
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(image.offset_bytes));
    file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (image.lost || !file_) {
      throw Fault{"lost_image", name(image, "depth") + ": damaged or cut off"};
    }
    return bytes;
  }

  [[nodiscard]] std::string name(OniImage const& image, char const* what) const {
    return path_.string() + ": " + what + " image " + std::to_string(image.number);
  }

  Grid<float> depth(OniImage const& image) {
    OniStream const& stream = index_.depth;
    auto const size =
        static_cast<std::size_t>(stream.width) * static_cast<std::size_t>(stream.height);
    std::optional<std::vector<std::uint16_t>> const counts =
        unpacked(read(image), stream.codec, size);
    if (!counts) {
      throw Fault{"unreadable_image",
                  name(image, "depth") + ": does not come out as " + size_text(stream)};
    }
    Grid<float> depth_m = depth_image(*counts, stream.width, stream.height, capture_);
    if (stream.mirrored) {
      mirror(depth_m);
    }
    return depth_m;
  }

  static std::optional<std::vector<std::uint16_t>> unpacked(Bytes const& bytes,
                                                            std::string const& codec,
                                                            std::size_t size) {
    if (codec == "16zT") {
      return unpack_16z_with_table(bytes, size);
    }
    if (codec == "16zP") {
      return unpack_16z(bytes, size);
    }
    if (bytes.size() != 2 * size) {
      return std::nullopt;
    }
    std::vector<std::uint16_t> counts(size);
    std::memcpy(counts.data(), bytes.data(), bytes.size());
    return counts;
  }

  /// Of the colour image nearest in time; empty where none is near.
  Grid<Rgb> color_near(std::int64_t stamp_ns) {
    if (!index_.color) {
      return {};
    }
    OniStream const& stream = *index_.color;
    auto const distance_ns = [&](OniImage const& image) {
      return std::abs(image.stamp_ns - stamp_ns);
    };
    auto nearest = std::ranges::lower_bound(stream.images, stamp_ns, {}, &OniImage::stamp_ns);
    if (nearest != stream.images.begin() &&
        (nearest == stream.images.end() || distance_ns(nearest[-1]) <= distance_ns(*nearest))) {
      --nearest;
    }
    if (nearest == stream.images.end() || distance_ns(*nearest) > window_ns_) {
      return {};
    }
    Grid<Rgb> color = decoded(*nearest, stream);
    if (stream.mirrored) {
      mirror(color);
    }
    return color;
  }

  Grid<Rgb> decoded(OniImage const& image, OniStream const& stream) {
    Bytes const bytes = read(image);
    Grid<Rgb> color(stream.width, stream.height);
    if (stream.codec == "JPEG") {
      Grid<Rgb> picture = decode_color(bytes, name(image, "colour"));
      if (picture.same_size(color)) {
        return picture;
      }
    } else if (bytes.size() == color.size() * sizeof(Rgb)) {
      std::memcpy(color.data(), bytes.data(), bytes.size());
      return color;
    }
    throw Fault{"unreadable_image",
                name(image, "colour") + ": does not come out as " + size_text(stream)};
  }

  [[nodiscard]] Se3 pose_of(FrameIndex index, std::int64_t stamp_ns) const {
    if (!trajectory_) {
      return {};
    }
    std::optional<Se3> const pose = trajectory_->at(index, stamp_ns);
    if (!pose) {
      throw Fault{"missing_pose", path_.string() + ": no pose for frame " +
                                      std::to_string(number(index)) +
                                      "; pose.source=fixed runs without poses"};
    }
    return *pose;
  }

  fs::path path_;
  CaptureConfig capture_;
  OniIndex index_;
  std::ifstream file_;
  CameraIntrinsics intrinsics_;
  std::optional<Trajectory> trajectory_;
  std::int64_t window_ns_ = 0;
  std::size_t position_ = 0;
};

}  // namespace

OpenedSource open_oni(fs::path const& path, CaptureConfig const& capture, PoseConfig const& pose) {
  check_oni_checksum(path);
  OpenedSource opened;
  auto source = std::make_unique<OniSource>(path, capture, pose);
  opened.warnings = source->warnings();
  opened.frame_count = source->frame_count();
  opened.source = std::move(source);
  return opened;
}

}  // namespace credo
