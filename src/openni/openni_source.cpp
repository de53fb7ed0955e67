#include "openni/openni_source.hpp"

#include <OpenNI.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "openni/sensor_image.hpp"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kFirstFrameGrace = std::chrono::seconds(10);
constexpr auto kStallAfter = std::chrono::seconds(2);
/// How long a request to stop may wait.
constexpr int kTick_ms = 100;
/// Half a frame's time at 30 Hz: what is farther apart is another frame's, and what has not come by
/// then does not come.
constexpr std::int64_t kPairing_ns = 1'000'000'000 / 30 / 2;
constexpr int kColorGrace_ms = 1000 / 30 / 2;
/// Enough to find the one nearest to a depth image that came a little late.
constexpr std::size_t kColorsKept = 4;

/// OpenNI ends its texts with line breaks, and knows none for some errors.
std::string openni_error() {
  std::string text = openni::OpenNI::getExtendedError();
  std::erase_if(text, [](char c) { return c == '\n' || c == '\t' || c == '\r'; });
  return text.empty() ? "OpenNI2 does not say why" : text;
}

/// The library, as long as it is needed.
class Library {
public:
  Library() {
    if (openni::OpenNI::initialize() != openni::STATUS_OK) {
      throw InputError("openni: OpenNI2 does not start: " + openni_error());
    }
  }
  Library(Library const&) = delete;
  Library& operator=(Library const&) = delete;
  Library(Library&&) = delete;
  Library& operator=(Library&&) = delete;
  ~Library() { openni::OpenNI::shutdown(); }
};

/// Hears of a device from OpenNI's threads: an unplugged one stays "valid".
class Listener : public openni::OpenNI::DeviceDisconnectedListener,
                 public openni::OpenNI::DeviceStateChangedListener {
public:
  explicit Listener(std::string uri) : uri_(std::move(uri)) {
    openni::OpenNI::addDeviceDisconnectedListener(this);
    openni::OpenNI::addDeviceStateChangedListener(this);
  }
  Listener(Listener const&) = delete;
  Listener& operator=(Listener const&) = delete;
  Listener(Listener&&) = delete;
  Listener& operator=(Listener&&) = delete;
  ~Listener() override {
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    openni::OpenNI::removeDeviceStateChangedListener(this);
  }

  void onDeviceDisconnected(openni::DeviceInfo const* info) override {
    unplugged_ = unplugged_ || uri_ == info->getUri();
  }
  void onDeviceStateChanged(openni::DeviceInfo const* info, openni::DeviceState state) override {
    // The only word that OpenNI has for the end of a recording.
    at_end_ = at_end_ || (uri_ == info->getUri() && state == openni::DEVICE_STATE_EOF);
  }

  [[nodiscard]] bool unplugged() const { return unplugged_; }
  [[nodiscard]] bool at_end() const { return at_end_; }

private:
  std::string uri_;
  std::atomic<bool> unplugged_ = false;
  std::atomic<bool> at_end_ = false;
};

struct ColorImage {
  std::int64_t stamp_ns = 0;
  Grid<Rgb> image;
};

class OpenniSource : public FrameSource {
public:
  OpenniSource(std::string uri, CaptureConfig const& capture, std::stop_token stop)
      : uri_(std::move(uri)), capture_(capture), stop_(std::move(stop)) {
    open();
    start_depth();
    start_color();
    if (!color_.isValid()) {
      warnings_.push_back(name() + ": has no colour of the size of its depth");
    }
    if (depth_.start() != openni::STATUS_OK) {
      throw InputError(name() + ": its depth does not start: " + openni_error());
    }
    intrinsics_ =
        intrinsics_of({mode_.getResolutionX(), mode_.getResolutionY(),
                       depth_.getHorizontalFieldOfView(), depth_.getVerticalFieldOfView()},
                      capture_);
    waits_until_ = Clock::now() + kFirstFrameGrace;
  }
  OpenniSource(OpenniSource const&) = delete;
  OpenniSource& operator=(OpenniSource const&) = delete;
  OpenniSource(OpenniSource&&) = delete;
  OpenniSource& operator=(OpenniSource&&) = delete;
  ~OpenniSource() override {
    depth_.stop();
    color_.stop();
    if (device_.isFile()) {
      // Its player of recordings has crashed where streams went while it still played.
      device_.close();
    }
    // Before their device: OpenNI2 frees what they use with it, and knows of no stream that runs.
    depth_.destroy();
    color_.destroy();
    device_.close();
  }

  [[nodiscard]] std::vector<std::string> const& warnings() const { return warnings_; }

  SourceResult next() override {
    // Time that the caller took is not the sensor's silence.
    auto const deadline = std::max(waits_until_, Clock::now() + kStallAfter);
    while (!stop_.stop_requested()) {
      if (listener_->unplugged()) {
        throw InputError(name() + ": was unplugged");
      }
      bool const came = wait_and_take();
      if (FramePtr frame = std::exchange(ready_, nullptr)) {
        waits_until_ = {};
        return frame;
      }
      if (!came && listener_->at_end()) {
        break;
      }
      if (!came && Clock::now() > deadline) {
        waits_until_ = {};
        return FrameFailure{next_index(), "stalled", name() + ": sends no depth" + why_, true};
      }
    }
    return EndOfSource{};
  }

private:
  [[nodiscard]] std::string name() const { return "openni:" + uri_; }

  void open() {
    char const* const uri = uri_.empty() ? openni::ANY_DEVICE : uri_.c_str();
    if (device_.open(uri) != openni::STATUS_OK) {
      throw InputError(uri_.empty() ? "openni: no sensor (" + openni_error() +
                                          "): is one plugged in, and of a kind that OpenNI2 has a "
                                          "driver for?"
                                    : name() + ": no such sensor: " + openni_error());
    }
    listener_.emplace(device_.getDeviceInfo().getUri());
    if (openni::PlaybackControl* playback = device_.getPlaybackControl()) {
      playback->setRepeatEnabled(false);
    }
  }

  void start_depth() {
    if (depth_.create(device_, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
      throw InputError(name() + ": has no depth: " + openni_error());
    }
    // What the sensor cannot do, it refuses, and is then done here, or not at all.
    depth_.setMirroringEnabled(false);
    mode_ = depth_.getVideoMode();
    if (mode_.getPixelFormat() != openni::PIXEL_FORMAT_DEPTH_1_MM) {
      throw InputError(name() + ": its depth is not in millimetres");
    }
    if (device_.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR)) {
      device_.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
    }
  }

  void start_color() {
    if (color_.create(device_, openni::SENSOR_COLOR) != openni::STATUS_OK) {
      return;
    }
    color_.setMirroringEnabled(false);
    openni::VideoMode const mode = color_.getVideoMode();
    bool const fits = mode.getPixelFormat() == openni::PIXEL_FORMAT_RGB888 &&
                      mode.getResolutionX() == mode_.getResolutionX() &&
                      mode.getResolutionY() == mode_.getResolutionY();
    if (!fits || color_.start() != openni::STATUS_OK) {
      color_.destroy();
    }
  }

  FrameIndex next_index() { return FrameIndex{frames_++}; }

  /// Row by row, as the stride may be longer than a row; empty where the frame is not whole.
  template <typename T>
  Grid<T> image_of(openni::VideoFrameRef const& frame, bool mirrored) const {
    Grid<T> image(mode_.getResolutionX(), mode_.getResolutionY());
    auto const stride = static_cast<std::size_t>(frame.getStrideInBytes());
    std::size_t const row_bytes = static_cast<std::size_t>(image.width()) * sizeof(T);
    if (frame.getWidth() != image.width() || frame.getHeight() != image.height() ||
        stride < row_bytes) {
      return {};
    }
    auto const* const data = static_cast<unsigned char const*>(frame.getData());
    for (int v = 0; v < image.height(); ++v) {
      std::memcpy(image.row(v).data(), data + static_cast<std::size_t>(v) * stride, row_bytes);
      if (mirrored) {
        std::ranges::reverse(image.row(v));
      }
    }
    return image;
  }

  static std::int64_t stamp_ns(openni::VideoFrameRef const& frame) {
    return static_cast<std::int64_t>(frame.getTimestamp()) * 1000;
  }

  /// Takes the next image of either stream, waiting for it a little; false where none came. Leaves
  /// a frame in ready_ once its depth has met its colour, or that has not come in time.
  bool wait_and_take() {
    std::array<openni::VideoStream*, 2> streams = {&depth_, &color_};
    int which = -1;
    openni::Status const status =
        openni::OpenNI::waitForAnyStream(streams.data(), color_.isValid() ? 2 : 1, &which,
                                         waiting_ != nullptr ? kColorGrace_ms : kTick_ms);
    if (status != openni::STATUS_OK) {
      why_.clear();
      if (status != openni::STATUS_TIME_OUT) {
        why_ = " (" + openni_error() + ")";
        std::this_thread::sleep_for(std::chrono::milliseconds(kTick_ms));  // it does not wait
      }
      release();
      return false;
    }
    if (which == 0) {
      release();
      waiting_ = take_depth();
    } else {
      take_color();
    }
    bool const met =
        waiting_ != nullptr &&
        (!color_.isValid() || (!colors_.empty() && colors_.back().stamp_ns >= waiting_->stamp_ns));
    if (ready_ == nullptr && met) {
      release();
    }
    return true;
  }

  /// The depth image that waits, with the colour that has come, is ready.
  void release() {
    if (waiting_ != nullptr) {
      waiting_->index = next_index();
      waiting_->color = color_near(waiting_->stamp_ns);
      ready_ = std::exchange(waiting_, nullptr);
    }
  }

  void take_color() {
    openni::VideoFrameRef frame;
    if (color_.readFrame(&frame) != openni::STATUS_OK) {
      return;
    }
    Grid<Rgb> image = image_of<Rgb>(frame, color_.getMirroringEnabled());
    if (!image.empty()) {
      colors_.push_back({stamp_ns(frame), std::move(image)});
    }
    if (colors_.size() > kColorsKept) {
      colors_.erase(colors_.begin());
    }
  }

  std::shared_ptr<Frame> take_depth() {
    openni::VideoFrameRef read;
    if (depth_.readFrame(&read) != openni::STATUS_OK) {
      return nullptr;
    }
    auto const counts = image_of<std::uint16_t>(read, depth_.getMirroringEnabled());
    if (counts.empty()) {
      return nullptr;
    }
    auto frame = std::make_shared<Frame>();
    frame->stamp_ns = stamp_ns(read);
    frame->intrinsics = intrinsics_;
    frame->cloud_camera = cloud_from_depth(
        depth_image({counts.data(), counts.size()}, counts.width(), counts.height(), capture_),
        intrinsics_);
    return frame;
  }

  [[nodiscard]] Grid<Rgb> color_near(std::int64_t stamp_ns) const {
    auto const distance_ns = [&](ColorImage const& color) {
      return std::abs(color.stamp_ns - stamp_ns);
    };
    auto const nearest = std::ranges::min_element(colors_, {}, distance_ns);
    return nearest != colors_.end() && distance_ns(*nearest) <= kPairing_ns ? nearest->image
                                                                            : Grid<Rgb>();
  }

  std::string uri_;
  CaptureConfig capture_;
  std::stop_token stop_;
  // In this order: the library goes last.
  Library library_;
  openni::Device device_;
  std::optional<Listener> listener_;
  openni::VideoStream depth_;
  openni::VideoStream color_;
  openni::VideoMode mode_;
  CameraIntrinsics intrinsics_;
  std::vector<std::string> warnings_;
  std::vector<ColorImage> colors_;
  /// A depth image whose colour may still come.
  std::shared_ptr<Frame> waiting_;
  FramePtr ready_;
  /// What OpenNI2 said where it did not wait for an image.
  std::string why_;
  std::int64_t frames_ = 0;
  /// Until then silence is no fault.
  Clock::time_point waits_until_;
};

}  // namespace

OpenedSource open_openni(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose, std::stop_token stop) {
  if (pose.source == PoseSource::kFile) {
    throw InputError("openni:" + uri +
                     ": a sensor's poses are not known beforehand; pose.source must not be file");
  }
  OpenedSource opened;
  auto source = std::make_unique<OpenniSource>(uri, capture, std::move(stop));
  opened.warnings = source->warnings();
  opened.source = std::move(source);
  return opened;
}

}  // namespace credo
