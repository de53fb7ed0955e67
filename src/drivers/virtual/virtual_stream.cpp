#include "drivers/virtual/virtual_stream.hpp"

#include <cmath>
#include <condition_variable>

#include "drivers/virtual/oni_property.hpp"

namespace credo {
namespace {

/// The first tick that is due at a time or later.
std::int64_t first_tick(std::int64_t time_ns, double rate_hz) {
  auto tick = static_cast<std::int64_t>(static_cast<double>(time_ns) * rate_hz / 1e9);
  while (tick_time_ns(tick, rate_hz) < time_ns) {
    ++tick;
  }
  return tick;
}

void wait_until(VirtualSensor::Clock::time_point due, std::stop_token const& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_until(lock, stop, due, [] { return false; });
}

}  // namespace

VirtualStream::VirtualStream(OpenedSensor& device, SensorStream kind)
    : device_(device), kind_(kind) {}

OniStatus VirtualStream::start() {
  if (kind_ == SensorStream::kColor && !device_.sensor.script().keeps_settings) {
    std::scoped_lock const lock(device_.mutex);
    device_.camera = {};
  }
  stop();
  thread_ = std::jthread([this](std::stop_token const& stop) { run(stop); });
  return ONI_STATUS_OK;
}

void VirtualStream::stop() {
  thread_ = {};
}

void VirtualStream::run(std::stop_token const& stop) {
  VirtualSensor& sensor = device_.sensor;
  double const rate_hz = sensor.schedule().rate_hz(kind_);
  std::int64_t const started_ns = sensor.start_ns();
  for (std::int64_t tick = first_tick(started_ns, rate_hz);; ++tick) {
    wait_until(sensor.due(tick_time_ns(tick, rate_hz)), stop);
    if (stop.stop_requested()) {
      return;
    }
    std::int64_t const newest = first_tick(sensor.now_ns(), rate_hz) - 1;
    if (newest > tick) {
      device_.too_late += newest - tick;
      tick = newest;
    }
    hand_out(tick, stop, started_ns);
  }
}

void VirtualStream::hand_out(std::int64_t tick, std::stop_token const& stop,
                             std::int64_t started_ns) {
  VirtualSensor& sensor = device_.sensor;
  SensorSchedule const& schedule = sensor.schedule();
  PlugState const plug = schedule.plug_state(tick_time_ns(tick, schedule.rate_hz(kind_)));
  if (plug != PlugState{true, device_.times_unplugged}) {
    return;
  }
  std::optional<ScheduledImage> const scheduled = schedule.at(kind_, tick, started_ns);
  if (!scheduled) {
    return;
  }
  SensorImagesPtr const images = sensor.store().at(schedule.position_of(kind_, tick), stop);
  OniFrame* const frame = images != nullptr ? getServices().acquireFrame() : nullptr;
  if (frame == nullptr) {
    return;
  }
  frame->frameIndex = static_cast<int>(tick);
  fill(*frame, *images, *scheduled);
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
  ++(kind_ == SensorStream::kDepth ? device_.depth_handed_out : device_.color_handed_out);
}

void VirtualStream::fill(OniFrame& frame, SensorImages const& images,
                         ScheduledImage const& scheduled) {
  ImageView shown = view();
  frame.croppingEnabled = shown.width_px != mode().resolutionX ? TRUE : FALSE;
  frame.croppingEnabled |= shown.height_px != mode().resolutionY ? TRUE : FALSE;
  if (scheduled.corruption == Corruption::kSize) {
    shown.width_px /= 2;
    shown.height_px /= 2;
  }
  frame.sensorType = kind_ == SensorStream::kDepth ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR;
  frame.videoMode = mode();
  frame.timestamp = scheduled.stamp_us;
  frame.width = shown.width_px;
  frame.height = shown.height_px;
  frame.cropOriginX = shown.left_px;
  frame.cropOriginY = shown.top_px;
  frame.stride = shown.width_px * pixel_bytes();
  frame.dataSize = frame.stride * shown.height_px;
  if (scheduled.corruption == Corruption::kGarbage) {
    fill_with_garbage(scheduled.seed, static_cast<unsigned char*>(frame.data),
                      static_cast<std::size_t>(frame.dataSize));
  } else if (kind_ == SensorStream::kColor) {
    copy_view(images.color, shown, static_cast<Rgb*>(frame.data));
  } else if (scheduled.registration_ignored ||
             device_.registration != ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR) {
    copy_view(unregistered(images.depth_mm, device_.sensor.dataset().intrinsics()), shown,
              static_cast<std::uint16_t*>(frame.data));
  } else {
    copy_view(images.depth_mm, shown, static_cast<std::uint16_t*>(frame.data));
  }
  if (scheduled.corruption == Corruption::kShort) {
    frame.dataSize /= 2;
  }
}

int VirtualStream::pixel_bytes() const {
  return kind_ == SensorStream::kDepth ? int{sizeof(std::uint16_t)} : int{sizeof(Rgb)};
}

OniVideoMode VirtualStream::mode() const {
  SensorDataset const& dataset = device_.sensor.dataset();
  return {kind_ == SensorStream::kDepth ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888,
          dataset.width(), dataset.height(),
          static_cast<int>(std::lround(device_.sensor.schedule().rate_hz(kind_)))};
}

int VirtualStream::getRequiredFrameSize() {
  return mode().resolutionX * mode().resolutionY * pixel_bytes();
}

ImageView VirtualStream::view() const {
  std::scoped_lock const lock(device_.mutex);
  ImageView view{mirrored_ != FALSE, 0, 0, mode().resolutionX, mode().resolutionY};
  if (cropping_.enabled != FALSE) {
    view.left_px = cropping_.originX;
    view.top_px = cropping_.originY;
    view.width_px = cropping_.width;
    view.height_px = cropping_.height;
  }
  return view;
}

float VirtualStream::field_of_view_rad(int id) const {
  CameraIntrinsics const& color = device_.sensor.dataset().intrinsics();
  bool const infrared = kind_ == SensorStream::kDepth &&
                        device_.registration != ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  CameraIntrinsics const k = infrared ? infrared_of(color) : color;
  bool const horizontal = id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV;
  double const half = 0.5 * (horizontal ? mode().resolutionX : mode().resolutionY);
  return static_cast<float>(2.0 * std::atan(half / (horizontal ? k.fx_px : k.fy_px)));
}

int* VirtualStream::setting(int id) {
  if (kind_ == SensorStream::kDepth) {
    return nullptr;
  }
  switch (id) {
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return &device_.camera.auto_white_balance;
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return &device_.camera.auto_exposure;
    case ONI_STREAM_PROPERTY_EXPOSURE:
      return &device_.camera.exposure;
    case ONI_STREAM_PROPERTY_GAIN:
      return &device_.camera.gain;
    default:
      return nullptr;
  }
}

OniBool VirtualStream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_CROPPING:
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_STRIDE:
    case ONI_STREAM_PROPERTY_MIRRORING:
      return TRUE;
    case ONI_STREAM_PROPERTY_MAX_VALUE:
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return kind_ == SensorStream::kDepth ? TRUE : FALSE;
    default:
      return setting(id) != nullptr ? TRUE : FALSE;
  }
}

OniStatus VirtualStream::getProperty(int id, void* data, int* size) {
  if (isPropertySupported(id) == FALSE) {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  switch (id) {
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return answer(field_of_view_rad(id), data, size);
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return answer(mode(), data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return answer(view().width_px * pixel_bytes(), data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return answer(int{kMaxDepth_mm}, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return answer(0, data, size);
    default:
      break;
  }
  std::scoped_lock const lock(device_.mutex);
  if (id == ONI_STREAM_PROPERTY_CROPPING) {
    return answer(cropping_, data, size);
  }
  return answer(id == ONI_STREAM_PROPERTY_MIRRORING ? mirrored_ : *setting(id), data, size);
}

OniStatus VirtualStream::set_cropping(OniCropping const& cropping) {
  bool const fits = cropping.originX >= 0 && cropping.originY >= 0 && cropping.width > 0 &&
                    cropping.height > 0 &&
                    cropping.originX <= mode().resolutionX - cropping.width &&
                    cropping.originY <= mode().resolutionY - cropping.height;
  if (cropping.enabled != FALSE && !fits) {
    return ONI_STATUS_BAD_PARAMETER;
  }
  std::scoped_lock const lock(device_.mutex);
  cropping_ = cropping;
  return ONI_STATUS_OK;
}

OniStatus VirtualStream::setProperty(int id, void const* data, int size) {
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
    auto const asked = asked_for<OniVideoMode>(data, size);
    OniVideoMode const only = mode();
    bool const same = asked && asked->pixelFormat == only.pixelFormat &&
                      asked->resolutionX == only.resolutionX &&
                      asked->resolutionY == only.resolutionY && asked->fps == only.fps;
    return same ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }
  if (id == ONI_STREAM_PROPERTY_CROPPING) {
    auto const asked = asked_for<OniCropping>(data, size);
    return asked ? set_cropping(*asked) : ONI_STATUS_BAD_PARAMETER;
  }
  std::scoped_lock const lock(device_.mutex);
  int* const kept = id == ONI_STREAM_PROPERTY_MIRRORING ? &mirrored_ : setting(id);
  if (kept == nullptr) {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  auto const asked = asked_for<int>(data, size);
  *kept = asked.value_or(*kept);
  return asked ? ONI_STATUS_OK : ONI_STATUS_BAD_PARAMETER;
}

}  // namespace credo
