#include "drivers/freenect/stream.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/freenect/properties.hpp"
#include "drivers/freenect/report.hpp"

namespace credo::freenect {
namespace {

/// Of the colour camera, and of depth that is registered to it; of the depth camera.
constexpr double kColorFocal_px = 525.0;
constexpr double kDepthFocal_px = 575.8;

float field_of_view_rad(int size_px, double focal_length_px) {
  return static_cast<float>(2.0 * std::atan(0.5 * size_px / focal_length_px));
}

int bytes_a_pixel(OniVideoMode const& mode) {
  return mode.pixelFormat == ONI_PIXEL_FORMAT_RGB888 ? 3 : 2;
}

bool same(OniVideoMode const& a, OniVideoMode const& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX &&
         a.resolutionY == b.resolutionY && a.fps == b.fps;
}

template <typename Pixel>
void mirror_rows(std::span<Pixel> image) {
  for (std::size_t row = 0; row < image.size(); row += kWidth_px) {
    std::ranges::reverse(image.subspan(row, kWidth_px));
  }
}

}  // namespace

OniSensorType KinectStream::sensor_of(StreamKind kind) {
  return kind == StreamKind::kDepth ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR;
}

OniVideoMode KinectStream::mode_of(StreamKind kind) {
  auto const format =
      kind == StreamKind::kDepth ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888;
  return {format, kWidth_px, kHeight_px, 30};
}

OniStatus KinectStream::start() {
  return reported(services_, [&] { kinect_.start(kind_); });
}

void KinectStream::stop() {
  // Of a lost Kinect there is nothing to stop.
  if (!kinect_.lost()) {
    reported(services_, [&] { kinect_.stop(kind_); });
  }
}

OniBool KinectStream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_STRIDE:
    case ONI_STREAM_PROPERTY_CROPPING:
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_MIRRORING:
    case ONI_STREAM_PROPERTY_MAX_VALUE:
    case ONI_STREAM_PROPERTY_MIN_VALUE:
    case kLostPacketsProperty:
    case kDroppedFramesProperty:
    case kStallsProperty:
      return TRUE;
    default:
      return FALSE;
  }
}

OniStatus KinectStream::getProperty(int id, void* data, int* size) {
  OniVideoMode const mode = mode_of(kind_);
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return answer(mode, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return answer(mode.resolutionX * bytes_a_pixel(mode), data, size);
    case ONI_STREAM_PROPERTY_CROPPING:
      return answer(OniCropping{FALSE, 0, 0, mode.resolutionX, mode.resolutionY}, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return answer(field_of_view_rad(mode.resolutionX, focal_length_px()), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return answer(field_of_view_rad(mode.resolutionY, focal_length_px()), data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return answer(OniBool{mirrored_ ? TRUE : FALSE}, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return answer(max_value(), data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return answer(0, data, size);
    case kLostPacketsProperty:
      return answer(kinect_.counts(kind_).lost_packets, data, size);
    case kDroppedFramesProperty:
      return answer(kinect_.counts(kind_).dropped_frames, data, size);
    case kStallsProperty:
      return answer(kinect_.counts(kind_).stalls, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus KinectStream::setProperty(int id, void const* data, int size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return reported(services_, [&] {
        if (!same(given<OniVideoMode>(data, size), mode_of(kind_))) {
          throw KinectError("a Kinect has 640 x 480 at 30 Hz, depth in mm and colour in RGB888");
        }
      });
    case ONI_STREAM_PROPERTY_MIRRORING:
      return reported(services_, [&] { mirrored_ = given<OniBool>(data, size) != FALSE; });
    case ONI_STREAM_PROPERTY_CROPPING:
      return reported(services_, [&] {
        if (given<OniCropping>(data, size).enabled != FALSE) {
          throw KinectError("a Kinect's images are not cropped");
        }
      });
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniFrame* KinectStream::new_frame(std::uint64_t stamp_us) {
  OniFrame* const frame = getServices().acquireFrame();
  if (frame != nullptr) {
    OniVideoMode const mode = mode_of(kind_);
    frame->sensorType = sensor_of(kind_);
    frame->timestamp = stamp_us;
    frame->frameIndex = ++frames_;
    frame->width = mode.resolutionX;
    frame->height = mode.resolutionY;
    frame->videoMode = mode;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = 0;
    frame->cropOriginY = 0;
    frame->stride = mode.resolutionX * bytes_a_pixel(mode);
    frame->dataSize = frame->stride * frame->height;
  }
  return frame;
}

void KinectStream::raise(OniFrame* frame) {
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

double DepthStream::focal_length_px() const {
  return registered_ ? kColorFocal_px : kDepthFocal_px;
}

void DepthStream::deliver(std::span<std::uint16_t const> depths_mm, DepthCleaner const& cleaner,
                          std::uint64_t stamp_us) {
  if (OniFrame* const frame = new_frame(stamp_us)) {
    std::span const pixels(static_cast<std::uint16_t*>(frame->data), depths_mm.size());
    cleaner.clean(depths_mm, pixels);
    if (mirrored()) {
      mirror_rows(pixels);
    }
    raise(frame);
  }
}

double ColorStream::focal_length_px() const {
  return kColorFocal_px;
}

void ColorStream::deliver(std::span<std::uint8_t const> rgb, std::uint64_t stamp_us) {
  if (OniFrame* const frame = new_frame(stamp_us)) {
    std::ranges::copy(rgb, static_cast<std::uint8_t*>(frame->data));
    if (mirrored()) {
      mirror_rows(std::span(static_cast<OniRGB888Pixel*>(frame->data), rgb.size() / 3));
    }
    raise(frame);
  }
}

OniBool ColorStream::isPropertySupported(int id) {
  bool const automatic =
      id == ONI_STREAM_PROPERTY_AUTO_EXPOSURE || id == ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE;
  return automatic ? TRUE : KinectStream::isPropertySupported(id);
}

OniStatus ColorStream::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return answer(OniBool{exposure_ ? TRUE : FALSE}, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return answer(OniBool{white_balance_ ? TRUE : FALSE}, data, size);
    default:
      return KinectStream::getProperty(id, data, size);
  }
}

OniStatus ColorStream::setProperty(int id, void const* data, int size) {
  bool const exposure = id == ONI_STREAM_PROPERTY_AUTO_EXPOSURE;
  if (!exposure && id != ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE) {
    return KinectStream::setProperty(id, data, size);
  }
  return reported(services(), [&] {
    bool const on = given<OniBool>(data, size) != FALSE;
    kinect().set_automatic(exposure ? Automatic::kExposure : Automatic::kWhiteBalance, on);
    (exposure ? exposure_ : white_balance_) = on;
  });
}

}  // namespace credo::freenect
