#include "drivers/freenect/open_kinect.hpp"

#include <libfreenect_registration.h>
#include <sys/time.h>

#include <algorithm>
#include <utility>

#include "drivers/freenect/bus.hpp"
#include "drivers/freenect/depth_cleaning.hpp"

namespace credo::freenect {
namespace {

constexpr std::size_t kPixels = std::size_t{kWidth_px} * kHeight_px;
/// A signal came while libusb waited.
constexpr int kInterrupted = -10;

/// libfreenect's log has no word for whose it is; it comes on the thread that called.
thread_local KinectEvents const* events_of_this_thread = nullptr;

void log_line(freenect_context* /*context*/, freenect_loglevel level, char const* line) {
  if (events_of_this_thread != nullptr) {
    events_of_this_thread->log(line, level < FREENECT_LOG_INFO);
  }
}

KinectEvents const& events_of(freenect_device* device) {
  return *static_cast<KinectEvents const*>(freenect_get_user(device));
}

void take_depth(freenect_device* device, void* data, std::uint32_t stamp) {
  events_of(device).depth({static_cast<std::uint16_t const*>(data), kPixels}, stamp);
}

void take_color(freenect_device* device, void* data, std::uint32_t stamp) {
  events_of(device).color({static_cast<std::uint8_t const*>(data), 3 * kPixels}, stamp);
}

}  // namespace

OpenKinect::OpenKinect(std::string const& serial, KinectEvents events)
    : events_(std::move(events)) {
  if (freenect_init(&context_, nullptr) < 0) {
    throw KinectError("libfreenect does not start: is USB there?");
  }
  events_of_this_thread = &events_;
  freenect_set_log_callback(context_, &log_line);
  // It tells of lost packets here alone.
  freenect_set_log_level(context_, FREENECT_LOG_INFO);
  // Without this it does not open where the motor is not to be had.
  freenect_select_subdevices(context_, FREENECT_DEVICE_CAMERA);
  try {
    open(serial);
  } catch (KinectError const&) {
    freenect_shutdown(context_);
    events_of_this_thread = nullptr;
    throw;
  }
}

void OpenKinect::open(std::string const& serial) {
  Presence const present = look_at_bus(context_);
  auto const found = std::ranges::find(present.serials, serial);
  if (found == present.serials.end()) {
    throw KinectError("is not plugged in");
  }
  // It opens by the place on the bus, of which the list leaves out what it could not read.
  if (present.unreadable > 0) {
    throw KinectError("may be mistaken for another: " + std::to_string(present.unreadable) +
                      " more plugged in may not be read; give the right by a udev rule, or "
                      "unplug them");
  }
  auto const place = static_cast<int>(found - present.serials.begin());
  if (freenect_open_device(context_, &device_, place) < 0) {
    throw KinectError(
        "does not open: is it in use by another program, or by the kernel's gspca_kinect?");
  }
  freenect_set_user(device_, &events_);
  freenect_set_depth_callback(device_, &take_depth);
  freenect_set_video_callback(device_, &take_color);
}

OpenKinect::~OpenKinect() {
  // Closing would stop one of them only.
  stop(StreamKind::kDepth);
  stop(StreamKind::kColor);
  freenect_close_device(device_);
  freenect_shutdown(context_);
  events_of_this_thread = nullptr;
}

void OpenKinect::start(StreamKind kind, bool registered) {
  int status = 0;
  if (kind == StreamKind::kColor) {
    freenect_set_video_mode(
        device_, freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB));
    status = freenect_start_video(device_);
  } else {
    auto const format = registered ? FREENECT_DEPTH_REGISTERED : FREENECT_DEPTH_MM;
    freenect_set_depth_mode(device_, freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM, format));
    status = freenect_start_depth(device_);
  }
  if (status < 0) {
    throw KinectError(kind == StreamKind::kDepth ? "its depth does not start"
                                                 : "its colour does not start");
  }
}

void OpenKinect::stop(StreamKind kind) {
  if (kind == StreamKind::kDepth) {
    freenect_stop_depth(device_);
  } else {
    freenect_stop_video(device_);
  }
}

void OpenKinect::set_automatic(Automatic which, bool on) {
  auto const flag =
      which == Automatic::kExposure ? FREENECT_AUTO_EXPOSURE : FREENECT_AUTO_WHITE_BALANCE;
  // A success may be positive.
  if (freenect_set_flag(device_, flag, on ? FREENECT_ON : FREENECT_OFF) < 0) {
    throw KinectError("its automatic exposure or white balance cannot be set");
  }
}

bool OpenKinect::process(std::chrono::milliseconds patience) {
  timeval timeout{.tv_sec = 0, .tv_usec = 1000 * patience.count()};
  int const status = freenect_process_events_timeout(context_, &timeout);
  return status >= 0 || status == kInterrupted;
}

std::vector<std::uint16_t> OpenKinect::false_depths() const {
  freenect_registration tables = freenect_copy_registration(device_);
  std::vector<std::uint16_t> found =
      false_depths_mm({tables.raw_to_mm_shift, FREENECT_DEPTH_RAW_MAX_VALUE});
  freenect_destroy_registration(&tables);
  return found;
}

}  // namespace credo::freenect
