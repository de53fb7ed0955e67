#include "openni/openni_source.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "geometry/depth_registration.hpp"
#include "openni/device_clock.hpp"
#include "openni/image_pairing.hpp"
#include "openni/openni_sensor.hpp"
#include "openni/registration_check.hpp"
#include "openni/sensor_image.hpp"
#include "openni/sensor_list.hpp"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// How long a request to stop may wait.
constexpr milliseconds kTick{100};
constexpr milliseconds kFirstRetry{250};
/// So many stalls in a row, and the sensor is opened anew.
constexpr int kStallsToReopen = 3;
constexpr double kLongestColorRetry_s = 60.0;
/// More images than any such sensor takes.
constexpr double kMostPerS = 120.0;

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

std::int64_t since_1970_ns(Clock::time_point when) {
  auto const then = std::chrono::system_clock::now() - (Clock::now() - when);
  return std::chrono::duration_cast<std::chrono::nanoseconds>(then.time_since_epoch()).count();
}

DepthCalibration kinect_calibration_of(DepthOptics const& optics) {
  constexpr double kKinectWidth_px = 640.0;
  return scaled(kinect_calibration(), optics.width_px / kKinectWidth_px);
}

class OpenniSource : public FrameSource {
public:
  OpenniSource(std::string const& uri, CaptureConfig const& capture, SensorConfig const& config,
               LiveNotes notes, std::stop_token stop)
      : uri_(uri),
        capture_(capture),
        config_(config),
        notes_(std::move(notes)),
        stop_(std::move(stop)) {
    connect(uri);
    kind_ = sensor_kind(sensor_->uri());
  }

  SourceResult next() override {
    // Time that the caller took is not the sensor's silence.
    quiet_until_ = std::max(quiet_until_, Clock::now() + seconds(config_.stall_s));
    while (!stop_.stop_requested()) {
      std::optional<SourceResult> result = sensor_ ? listen() : look_for_sensor();
      if (result) {
        return std::move(*result);
      }
    }
    return EndOfSource{};
  }

private:
  [[nodiscard]] std::string name() const { return "openni:" + uri_; }
  FrameIndex next_index() { return FrameIndex{frames_++}; }
  void tell(std::string const& what) const {
    if (notes_) {
      notes_(name() + ": " + what);
    }
  }

  FrameFailure silence(std::string reason, std::string const& what) {
    quiet_until_ = Clock::now() + seconds(config_.stall_s);
    return {next_index(), std::move(reason), name() + ": " + what, Loss::kSilence};
  }

  void connect(std::string const& uri) {
    sensor_ = std::make_unique<OpenniSensor>(uri, config_);
    uri_ = sensor_->uri();
    intrinsics_ = intrinsics_of(sensor_->optics(), capture_);
    settle_registration();
    pairing_.clear();
    pairing_.expect_color(sensor_->has_color());
    quiet_until_ = Clock::now() + seconds(config_.first_frame_s);
    color_due_ = quiet_until_;
    color_retry_ = seconds(config_.stall_s);
    stalls_ = 0;
    last_depth_.reset();
    for (std::string const& warning : sensor_->warnings()) {
      if (notes_) {
        notes_(warning);
      }
    }
  }

  /// What the sensor's next image makes, if anything.
  std::optional<SourceResult> listen() {
    if (missed_ > 0) {
      --missed_;
      return FrameFailure{next_index(), "missed",
                          name() + ": an image did not come, or was not taken in time",
                          Loss::kMissed};
    }
    auto const most =
        pairing_.is_waiting() ? std::chrono::ceil<milliseconds>(ImagePairing::kNear) : kTick;
    SensorImage image = sensor_->next(most);
    switch (image.kind) {
      case SensorImage::Kind::kUnplugged:
        if (std::optional<SourceResult> last = frame_of(pairing_.take_now())) {
          return last;
        }
        return lose("unplugged", "was unplugged; waiting for it to come back");
      case SensorImage::Kind::kBroken:
        count_missed(image);
        return FrameFailure{next_index(), "broken_image",
                            name() + ": sent " + image.why + "; is its cable sound?"};
      case SensorImage::Kind::kDepth:
        return depth(std::move(image));
      case SensorImage::Kind::kColor:
        color(std::move(image));
        return frame_of(pairing_.take());
      case SensorImage::Kind::kNone:
        break;
      case SensorImage::Kind::kEnd:
        if (std::optional<SourceResult> last = frame_of(pairing_.take_now())) {
          return last;
        }
        return EndOfSource{};
    }
    if (std::optional<SourceResult> late = frame_of(pairing_.take_now())) {
      return late;
    }
    return Clock::now() > quiet_until_ ? stalled(image.why) : std::nullopt;
  }

  std::optional<SourceResult> depth(SensorImage image) {
    quiet_until_ = Clock::now() + seconds(config_.stall_s);
    stalls_ = 0;
    watch_color();
    count_missed(image);
    std::optional<SourceResult> before = frame_of(pairing_.take_now());
    std::int64_t const stamp_ns = time_ns(image);
    pairing_.add(DepthImage{stamp_ns, image.arrival, std::move(image.counts)});
    return before || missed_ > 0 ? before : frame_of(pairing_.take());
  }

  /// By the sensor's own numbers, as far as there was time for so many.
  void count_missed(SensorImage const& image) {
    if (last_depth_ && image.number > last_depth_->number) {
      auto const passed = std::chrono::duration<double>(image.arrival - last_depth_->arrival);
      int const missed = image.number - last_depth_->number - 1;
      missed_ = missed <= kMostPerS * (1.0 + passed.count()) ? missed : 0;
    }
    last_depth_ = {image.number, image.arrival};
  }

  void color(SensorImage image) {
    color_due_ = image.arrival + seconds(config_.stall_s);
    color_retry_ = seconds(config_.stall_s);
    pairing_.add(ColorImage{clock_.following_time_ns(image.stamp_us, image.arrival),
                            std::move(image.color)});
  }

  /// Depth goes on without colour, and colour is started anew now and then.
  void watch_color() {
    if (!sensor_->has_color() || Clock::now() < color_due_) {
      return;
    }
    tell("sends no colour; starting it anew");
    sensor_->restart_color();
    color_due_ = Clock::now() + color_retry_;
    color_retry_ = std::min(2 * color_retry_, seconds(kLongestColorRetry_s));
  }

  std::int64_t time_ns(SensorImage const& image) {
    std::uint64_t const jumps = clock_.jumps();
    std::int64_t const time_ns = clock_.time_ns(image.stamp_us, image.arrival);
    if (clock_.jumps() > jumps) {
      tell("its clock jumped; time goes on by this computer's");
    }
    return time_ns;
  }

  std::optional<SourceResult> frame_of(std::optional<ImagePair> pair) {
    if (!pair) {
      return std::nullopt;
    }
    auto frame = std::make_shared<Frame>();
    frame->index = next_index();
    frame->stamp_ns = pair->depth.stamp_ns;
    frame->arrival_ns = since_1970_ns(pair->depth.arrival);
    frame->intrinsics = intrinsics_;
    Grid<std::uint16_t> const& counts = pair->depth.counts;
    Grid<float> depth_m =
        depth_image({counts.data(), counts.size()}, counts.width(), counts.height(), capture_);
    frame->color = std::move(pair->color);
    check_registration(depth_m, frame->color);
    if (registers_here_) {
      depth_m = register_depth(depth_m, calibration_, counts.width(), counts.height());
    }
    frame->color_registered =
        is_color_registered(capture_, registers_here_ || sensor_->says_registered());
    frame->cloud_camera = cloud_from_depth(std::move(depth_m), intrinsics_);
    return FramePtr(std::move(frame));
  }

  /// What a sensor says of its registration is not always what it does.
  void check_registration(Grid<float> const& depth_m, Grid<Rgb> const& color) {
    if (config_.registration == RegistrationMode::kAuto && !registers_here_ &&
        check_.add(depth_m, color) == Registration::kUnregistered) {
      tell("its images show that its depth is not registered: it is registered here from now on");
      register_here();
    }
  }

  /// Depth is then the colour camera's. Where the sensor says that it does not register, its field
  /// of view is the depth camera's; what it does not tell is as in a Kinect.
  void register_here() {
    DepthOptics const optics = sensor_->optics();
    calibration_ = kinect_calibration_of(optics);
    if (!sensor_->says_registered()) {
      calibration_.depth = intrinsics_of(optics, {});
    }
    calibration_.color = intrinsics_of(sensor_->color_optics(), capture_);
    intrinsics_ = calibration_.color;
    registers_here_ = true;
  }

  /// Of a sensor that was just opened.
  void settle_registration() {
    DepthOptics const optics = sensor_->optics();
    check_ = RegistrationCheck(kinect_calibration_of(optics));
    bool const cannot = config_.registration == RegistrationMode::kAuto &&
                        !sensor_->says_registered() && !sensor_->is_recording();
    registers_here_ = false;
    if (sensor_->has_color() && (cannot || config_.registration == RegistrationMode::kSoftware)) {
      register_here();
    }
  }

  std::optional<SourceResult> stalled(std::string const& why) {
    if (++stalls_ >= kStallsToReopen) {
      return lose("stalled", "sends no depth; opening it anew");
    }
    return silence("stalled", "sends no depth" + (why.empty() ? "" : " (" + why + ")"));
  }

  /// Closes what does not come back by itself. Its old objects are of no use, even once the sensor
  /// is plugged in again.
  std::optional<SourceResult> lose(std::string reason, std::string const& what) {
    sensor_.reset();
    pairing_.clear();
    missed_ = 0;
    why_.clear();
    lost_at_ = Clock::now();
    retry_ = kFirstRetry;
    retry_at_ = lost_at_ + retry_;
    return silence(std::move(reason), what);
  }

  std::optional<SourceResult> look_for_sensor() {
    if (Clock::now() >= retry_at_) {
      if (try_to_connect()) {
        return std::nullopt;
      }
      retry_ = std::min(std::chrono::duration_cast<Clock::duration>(2 * retry_),
                        seconds(config_.retry_s));
      retry_at_ = Clock::now() + retry_;
    }
    if (Clock::now() > quiet_until_) {
      auto const away = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - lost_at_);
      return silence("away", "has been away for " + std::to_string(away.count()) + " s" + why_);
    }
    std::this_thread::sleep_for(std::min<Clock::duration>(kTick, retry_at_ - Clock::now()));
    return std::nullopt;
  }

  /// By its URI, or, as a sensor in another socket has another, the only one of its kind.
  bool try_to_connect() {
    std::vector<std::string> const there = sensor_uris(kind_);
    bool const same = std::ranges::find(there, uri_) != there.end();
    if (!same && there.size() != 1) {
      why_ = there.empty() ? "" : "; several of its kind are there, but not this one";
      return false;
    }
    try {
      connect(same ? uri_ : there.front());
    } catch (InputError const& error) {
      sensor_.reset();
      why_ = std::string(": ") + error.what();
      return false;
    }
    clock_.restart();
    auto const away =
        std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - lost_at_);
    tell("is back after " + std::to_string(away.count() / 1000) + "." +
         std::to_string(away.count() / 100 % 10) + " s");
    return true;
  }

  /// As OpenNI2 names it, once it was opened.
  std::string uri_;
  CaptureConfig capture_;
  SensorConfig config_;
  LiveNotes notes_;
  std::stop_token stop_;
  // In this order: the library goes last.
  OpenniLibrary library_;
  /// None while it is away.
  std::unique_ptr<OpenniSensor> sensor_;
  std::optional<std::uint32_t> kind_;
  CameraIntrinsics intrinsics_;
  RegistrationCheck check_;
  /// Depth comes as the depth camera sees it.
  bool registers_here_ = false;
  DepthCalibration calibration_;
  DeviceClock clock_;
  ImagePairing pairing_;
  std::int64_t frames_ = 0;
  /// Until then silence is no fault.
  Clock::time_point quiet_until_;
  int stalls_ = 0;
  /// Until then no colour is no fault, and how long after a new start.
  Clock::time_point color_due_;
  Clock::duration color_retry_{};
  struct Numbered {
    int number = 0;
    Clock::time_point arrival;
  };
  std::optional<Numbered> last_depth_;
  /// Images that did not come before the one that waits in pairing_.
  int missed_ = 0;
  Clock::time_point lost_at_;
  Clock::time_point retry_at_;
  Clock::duration retry_{};
  /// Why the sensor could not be opened again.
  std::string why_;
};

}  // namespace

OpenedSource open_openni(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose, SensorConfig const& sensor, LiveNotes notes,
                         std::stop_token stop) {
  if (pose.source == PoseSource::kFile) {
    throw InputError("openni:" + uri +
                     ": a sensor's poses are not known beforehand; pose.source must not be file");
  }
  OpenedSource opened;
  opened.source =
      std::make_unique<OpenniSource>(uri, capture, sensor, std::move(notes), std::move(stop));
  return opened;
}

}  // namespace credo
