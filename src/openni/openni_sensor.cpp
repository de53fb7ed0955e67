#include "openni/openni_sensor.hpp"

#include <OpenNI.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "openni/openni_error.hpp"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;

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

/// Row by row, as the stride may be longer than a row; empty where the image is not whole.
template <typename T>
Grid<T> image_of(openni::VideoFrameRef const& frame, openni::VideoMode const& mode, bool mirrored) {
  Grid<T> image(mode.getResolutionX(), mode.getResolutionY());
  auto const stride = static_cast<std::size_t>(std::max(frame.getStrideInBytes(), 0));
  std::size_t const row_bytes = static_cast<std::size_t>(image.width()) * sizeof(T);
  auto const held = static_cast<std::size_t>(std::max(frame.getDataSize(), 0));
  auto const rows = static_cast<std::size_t>(image.height());
  if (frame.getWidth() != image.width() || frame.getHeight() != image.height() ||
      stride < row_bytes || held < (rows - 1) * stride + row_bytes) {
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

}  // namespace

class OpenniSensor::Open {
public:
  Open(std::string const& uri, SensorConfig const& config) : config_(config) {
    open(uri);
    create_depth();
    create_color();
    if (depth_.start() != openni::STATUS_OK) {
      throw InputError(name() + ": its depth does not start: " + openni_error());
    }
    // Sensors forget what they are told before their streams start.
    register_depth();
    apply_color_settings();
  }
  Open(Open const&) = delete;
  Open& operator=(Open const&) = delete;
  Open(Open&&) = delete;
  Open& operator=(Open&&) = delete;
  ~Open() {
    stop_recording();
    if (device_.isFile()) {
      // OpenNI2's player of recordings has crashed where streams went while it still played.
      device_.close();
    }
    // Before their device: OpenNI2 frees what they use with it, and knows of no stream that runs.
    depth_.destroy();
    color_.destroy();
    device_.close();
  }

  [[nodiscard]] std::string const& uri() const { return uri_; }
  [[nodiscard]] bool has_color() const { return color_.isValid(); }
  [[nodiscard]] std::vector<std::string> const& warnings() const { return warnings_; }
  [[nodiscard]] bool is_recording() const { return device_.isFile(); }
  [[nodiscard]] bool says_registered() const {
    return device_.getImageRegistrationMode() == openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  }
  [[nodiscard]] int depth_rate_hz() const { return mode_.getFps(); }
  [[nodiscard]] int color_rate_hz() const { return color_.getVideoMode().getFps(); }
  [[nodiscard]] DepthOptics color_optics() const {
    return {mode_.getResolutionX(), mode_.getResolutionY(), color_.getHorizontalFieldOfView(),
            color_.getVerticalFieldOfView()};
  }
  [[nodiscard]] DepthOptics optics() const {
    return {mode_.getResolutionX(), mode_.getResolutionY(), depth_.getHorizontalFieldOfView(),
            depth_.getVerticalFieldOfView()};
  }

  SensorImage next(std::chrono::milliseconds most) {
    if (listener_->unplugged()) {
      return without_image(SensorImage::Kind::kUnplugged);
    }
    std::array<openni::VideoStream*, 2> streams = {&depth_, &color_};
    int which = -1;
    openni::Status const status = openni::OpenNI::waitForAnyStream(
        streams.data(), has_color() ? 2 : 1, &which, static_cast<int>(most.count()));
    if (status == openni::STATUS_OK) {
      return which == 0 ? take_depth() : take_color();
    }
    std::string why;
    if (status != openni::STATUS_TIME_OUT) {
      why = openni_error();
      std::this_thread::sleep_for(most);  // it did not wait
    }
    return without_image(listener_->unplugged() ? SensorImage::Kind::kUnplugged
                         : listener_->at_end()  ? SensorImage::Kind::kEnd
                                                : SensorImage::Kind::kNone,
                         std::move(why));
  }

  bool restart_color() {
    color_.stop();
    bool const started = color_.start() == openni::STATUS_OK;
    apply_color_settings();
    return started;
  }

  void start_recording(std::filesystem::path const& file) {
    constexpr bool kWithLoss = false;
    if (recorder_.create(std::filesystem::absolute(file).c_str()) != openni::STATUS_OK ||
        recorder_.attach(depth_, kWithLoss) != openni::STATUS_OK ||
        (has_color() && recorder_.attach(color_, kWithLoss) != openni::STATUS_OK) ||
        recorder_.start() != openni::STATUS_OK) {
      throw InputError(file.string() + ": OpenNI2 does not record into it: " + openni_error());
    }
  }
  /// In this order: a recorder that is stopped while an image comes waits for its stream, and that
  /// for the recorder, for ever.
  void stop_recording() {
    depth_.stop();
    color_.stop();
    recorder_.stop();
    recorder_.destroy();
  }

private:
  [[nodiscard]] std::string name() const { return "openni:" + uri_; }

  void open(std::string const& uri) {
    uri_ = uri;
    if (device_.open(uri.empty() ? openni::ANY_DEVICE : uri.c_str()) != openni::STATUS_OK) {
      throw InputError(uri.empty() ? "openni: no sensor (" + openni_error() +
                                         "): is one plugged in, and of a kind that OpenNI2 has a "
                                         "driver for? `credo devices` lists what it sees"
                                   : name() + ": no such sensor: " + openni_error() +
                                         "; `credo devices` lists those that are there");
    }
    uri_ = device_.getDeviceInfo().getUri();
    listener_.emplace(uri_);
    if (openni::PlaybackControl* playback = device_.getPlaybackControl()) {
      playback->setRepeatEnabled(false);
    }
  }

  void create_depth() {
    if (depth_.create(device_, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
      throw InputError(name() + ": has no depth: " + openni_error());
    }
    // What the sensor cannot do, it refuses, and is then done here, or not at all.
    depth_.setMirroringEnabled(false);
    mode_ = depth_.getVideoMode();
    if (mode_.getPixelFormat() != openni::PIXEL_FORMAT_DEPTH_1_MM) {
      throw InputError(name() + ": its depth is not in millimetres");
    }
  }

  [[nodiscard]] bool fits(openni::VideoMode const& mode) const {
    return mode.getPixelFormat() == openni::PIXEL_FORMAT_RGB888 &&
           mode.getResolutionX() == mode_.getResolutionX() &&
           mode.getResolutionY() == mode_.getResolutionY();
  }

  void create_color() {
    if (color_.create(device_, openni::SENSOR_COLOR) == openni::STATUS_OK) {
      color_.setMirroringEnabled(false);
      auto const& modes = color_.getSensorInfo().getSupportedVideoModes();
      for (int i = 0; i < modes.getSize() && !fits(color_.getVideoMode()); ++i) {
        if (fits(modes[i]) && modes[i].getFps() == mode_.getFps()) {
          color_.setVideoMode(modes[i]);
        }
      }
      if (!fits(color_.getVideoMode()) || color_.start() != openni::STATUS_OK) {
        color_.destroy();
      }
    }
    if (!color_.isValid()) {
      warnings_.push_back(name() + ": has no colour of the size of its depth");
    }
  }

  void register_depth() {
    bool const by_sensor = config_.registration == RegistrationMode::kAuto ||
                           config_.registration == RegistrationMode::kSensor;
    openni::ImageRegistrationMode const wanted =
        by_sensor ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR : openni::IMAGE_REGISTRATION_OFF;
    if (device_.isImageRegistrationModeSupported(wanted)) {
      device_.setImageRegistrationMode(wanted);
    }
  }

  void apply_color_settings() {
    openni::CameraSettings* const settings = has_color() ? color_.getCameraSettings() : nullptr;
    if (settings == nullptr) {
      return;
    }
    auto const check = [&](openni::Status status, char const* what) {
      if (status != openni::STATUS_OK) {
        warnings_.push_back(name() + ": does not take sensor." + what + ": " + openni_error());
      }
    };
    if (config_.auto_exposure != SensorSwitch::kKeep) {
      check(settings->setAutoExposureEnabled(config_.auto_exposure == SensorSwitch::kOn),
            "auto_exposure");
    }
    if (config_.auto_white_balance != SensorSwitch::kKeep) {
      check(settings->setAutoWhiteBalanceEnabled(config_.auto_white_balance == SensorSwitch::kOn),
            "auto_white_balance");
    }
    if (config_.exposure > 0) {
      check(settings->setExposure(config_.exposure), "exposure");
    }
    if (config_.gain > 0) {
      check(settings->setGain(config_.gain), "gain");
    }
  }

  static SensorImage without_image(SensorImage::Kind kind, std::string why = "") {
    SensorImage none;
    none.kind = kind;
    none.why = std::move(why);
    return none;
  }

  static SensorImage described(openni::VideoFrameRef const& frame) {
    SensorImage image;
    image.stamp_us = frame.getTimestamp();
    image.number = frame.getFrameIndex();
    image.arrival = Clock::now();
    return image;
  }

  SensorImage take_depth() {
    openni::VideoFrameRef read;
    if (depth_.readFrame(&read) != openni::STATUS_OK) {
      return without_image(SensorImage::Kind::kNone, openni_error());
    }
    SensorImage image = described(read);
    image.counts = image_of<std::uint16_t>(read, mode_, depth_.getMirroringEnabled());
    image.kind = image.counts.empty() ? SensorImage::Kind::kBroken : SensorImage::Kind::kDepth;
    if (image.counts.empty()) {
      image.why = "a depth image of " + std::to_string(read.getWidth()) + "x" +
                  std::to_string(read.getHeight()) + " pixels in " +
                  std::to_string(read.getDataSize()) + " bytes";
    }
    return image;
  }

  SensorImage take_color() {
    openni::VideoFrameRef read;
    if (color_.readFrame(&read) != openni::STATUS_OK) {
      return {};
    }
    SensorImage image = described(read);
    image.color = image_of<Rgb>(read, color_.getVideoMode(), color_.getMirroringEnabled());
    image.kind = image.color.empty() ? SensorImage::Kind::kNone : SensorImage::Kind::kColor;
    return image;
  }

  SensorConfig config_;
  std::string uri_;
  openni::Device device_;
  std::optional<Listener> listener_;
  openni::VideoStream depth_;
  openni::VideoStream color_;
  openni::Recorder recorder_;
  openni::VideoMode mode_;
  std::vector<std::string> warnings_;
};

OpenniSensor::OpenniSensor(std::string const& uri, SensorConfig const& config)
    : open_(std::make_unique<Open>(uri, config)) {}
OpenniSensor::~OpenniSensor() = default;

std::string const& OpenniSensor::uri() const {
  return open_->uri();
}
DepthOptics OpenniSensor::optics() const {
  return open_->optics();
}
DepthOptics OpenniSensor::color_optics() const {
  return open_->color_optics();
}
bool OpenniSensor::has_color() const {
  return open_->has_color();
}
int OpenniSensor::depth_rate_hz() const {
  return open_->depth_rate_hz();
}
int OpenniSensor::color_rate_hz() const {
  return open_->color_rate_hz();
}
bool OpenniSensor::is_recording() const {
  return open_->is_recording();
}
bool OpenniSensor::says_registered() const {
  return open_->says_registered();
}
std::vector<std::string> const& OpenniSensor::warnings() const {
  return open_->warnings();
}
SensorImage OpenniSensor::next(std::chrono::milliseconds most) {
  return open_->next(most);
}
bool OpenniSensor::restart_color() {
  return open_->restart_color();
}
void OpenniSensor::start_recording(std::filesystem::path const& file) {
  open_->start_recording(file);
}
void OpenniSensor::stop_recording() {
  open_->stop_recording();
}

OpenniLibrary::OpenniLibrary() {
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    throw InputError("openni: OpenNI2 does not start: " + openni_error());
  }
}
OpenniLibrary::~OpenniLibrary() {
  openni::OpenNI::shutdown();
}

}  // namespace credo
