#include <algorithm>
#include <chrono>
#include <utility>

#include "doctor/sensor_measurement.hpp"
#include "openni/device_clock.hpp"
#include "openni/image_pairing.hpp"
#include "openni/openni_sensor.hpp"
#include "openni/sensor_list.hpp"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{100};
/// So many views are kept, as far apart in time, whatever the length of the measurement.
constexpr std::size_t kMostViews = 16;
constexpr double kLeastApart_s = 0.15;

class Measuring {
public:
  Measuring(std::string const& uri, CaptureConfig const& capture, SensorConfig const& config,
            MeasureProgress const& progress)
      : capture_(capture), progress_(progress), sensor_(uri, config) {
    result_.uri = sensor_.uri();
    result_.usb_vendor = static_cast<std::uint16_t>(sensor_kind(sensor_.uri()).value_or(0) >> 16U);
    result_.warnings = sensor_.warnings();
    result_.is_recording = sensor_.is_recording();
    result_.has_color = sensor_.has_color();
    result_.depth_rate_hz = sensor_.depth_rate_hz();
    result_.color_rate_hz = result_.has_color ? sensor_.color_rate_hz() : 0;
    result_.optics = sensor_.optics();
    result_.says_registered = sensor_.says_registered();
    pairing_.expect_color(result_.has_color);
  }

  SensorMeasurement measure(double first_frame_s, double seconds) && {
    auto const opened = Clock::now();
    while (result_.depth.empty() && !ended_ && since(opened) < first_frame_s) {
      progress_("waiting for its first depth image", since(opened), first_frame_s);
      take();
    }
    result_.waited_s = since(opened);
    auto const first = Clock::now();
    view_every_s_ = std::max(kLeastApart_s, seconds / kMostViews);
    while (!result_.depth.empty() && !ended_ && since(first) < seconds) {
      progress_("measuring", since(first), seconds);
      take();
    }
    result_.measured_s = since(first);
    result_.clock_jumps = clock_.jumps();
    result_.says_registered = sensor_.says_registered();
    result_.evidence = evidence_of(views_, result_.optics, capture_);
    return std::move(result_);
  }

private:
  static double since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  }

  void take() {
    SensorImage image = sensor_.next(kTick);
    switch (image.kind) {
      case SensorImage::Kind::kDepth: {
        std::int64_t const stamp_ns = clock_.time_ns(image.stamp_us, image.arrival);
        result_.depth.push_back({stamp_ns, image.arrival, image.number});
        keep(pairing_.take_now());
        pairing_.add(DepthImage{stamp_ns, image.arrival, std::move(image.counts)});
        break;
      }
      case SensorImage::Kind::kColor: {
        std::int64_t const stamp_ns = clock_.following_time_ns(image.stamp_us, image.arrival);
        result_.color.push_back({stamp_ns, image.arrival, image.number});
        pairing_.add(ColorImage{stamp_ns, std::move(image.color)});
        break;
      }
      case SensorImage::Kind::kBroken:
        ++result_.broken;
        result_.broken_why = image.why;
        break;
      case SensorImage::Kind::kUnplugged:
        result_.unplugged = true;
        ended_ = true;
        break;
      case SensorImage::Kind::kEnd:
        ended_ = true;
        break;
      case SensorImage::Kind::kNone:
        break;
    }
    keep(pairing_.take());
  }

  /// Images are judged afterwards: what takes time here would cost images.
  void keep(std::optional<ImagePair> pair) {
    if (!pair || views_.size() >= kMostViews ||
        (!views_.empty() && since(last_view_) < view_every_s_)) {
      return;
    }
    Grid<std::uint16_t> const& counts = pair->depth.counts;
    views_.push_back(
        {depth_image({counts.data(), counts.size()}, counts.width(), counts.height(), capture_),
         std::move(pair->color)});
    last_view_ = Clock::now();
  }

  CaptureConfig const& capture_;
  MeasureProgress const& progress_;
  OpenniSensor sensor_;
  SensorMeasurement result_;
  DeviceClock clock_;
  ImagePairing pairing_;
  std::vector<SensorView> views_;
  Clock::time_point last_view_;
  double view_every_s_ = kLeastApart_s;
  bool ended_ = false;
};

}  // namespace

SensorMeasurement measure_sensor(std::string const& uri, double seconds,
                                 CaptureConfig const& capture, SensorConfig const& sensor,
                                 MeasureProgress const& progress) {
  return Measuring(uri, capture, sensor, progress).measure(sensor.first_frame_s, seconds);
}

}  // namespace credo
