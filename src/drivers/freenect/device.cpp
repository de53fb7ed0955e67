#include "drivers/freenect/device.hpp"

#include <algorithm>

#include "drivers/freenect/report.hpp"

namespace credo::freenect {
namespace {

constexpr std::array kKinds = {StreamKind::kDepth, StreamKind::kColor};

}  // namespace

KinectDevice::KinectDevice(std::string const& serial, oni::driver::DriverServices& services)
    : serial_(serial), services_(services), kinect_(serial, sinks()) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    modes_[i] = KinectStream::mode_of(kKinds[i]);
    sensors_[i] = {KinectStream::sensor_of(kKinds[i]), 1, &modes_[i]};
  }
}

KinectDevice::~KinectDevice() {
  kinect_.close();
  delete depth_;
  delete color_;
}

KinectSinks KinectDevice::sinks() {
  return {[this](std::span<std::uint16_t const> depths_mm, DepthCleaner const& cleaner,
                 std::uint64_t stamp_us) {
            if (DepthStream* const stream = depth_) {
              stream->deliver(depths_mm, cleaner, stamp_us);
            }
          },
          [this](std::span<std::uint8_t const> rgb, std::uint64_t stamp_us) {
            if (ColorStream* const stream = color_) {
              stream->deliver(rgb, stamp_us);
            }
          },
          [this](std::string const& line) {
            log_warning(services_, "Kinect " + serial_ + ": " + line);
          }};
}

OniStatus KinectDevice::getSensorInfoList(OniSensorInfo** infos, int* count) {
  *infos = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* KinectDevice::createStream(OniSensorType sensor) {
  if (sensor == ONI_SENSOR_DEPTH && depth_ == nullptr) {
    depth_ = new DepthStream(kinect_, services_, registered_);
    return depth_;
  }
  if (sensor == ONI_SENSOR_COLOR && color_ == nullptr) {
    color_ = new ColorStream(kinect_, services_);
    return color_;
  }
  append_error(services_, "a Kinect has one stream of depth and one of colour");
  return nullptr;
}

void KinectDevice::destroyStream(oni::driver::StreamBase* stream) {
  stream->stop();
  if (stream == depth_) {
    depth_ = nullptr;
  } else if (stream == color_) {
    color_ = nullptr;
  }
  kinect_.wait_told();
  delete stream;
}

OniBool KinectDevice::isPropertySupported(int id) {
  return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION
             ? TRUE
             : FALSE;
}

OniStatus KinectDevice::getProperty(int id, void* data, int* size) {
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) {
    return answer(registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF,
                  data, size);
  }
  if (id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER) {
    auto const bytes = serial_.size() + 1;
    if (*size < static_cast<int>(bytes)) {
      return ONI_STATUS_BAD_PARAMETER;
    }
    std::copy_n(serial_.c_str(), bytes, static_cast<char*>(data));
    *size = static_cast<int>(bytes);
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus KinectDevice::setProperty(int id, void const* data, int size) {
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  return reported(services_, [&] {
    bool const registered =
        given<OniImageRegistrationMode>(data, size) == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    kinect_.set_registered(registered);
    registered_ = registered;
  });
}

OniBool KinectDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR
             ? TRUE
             : FALSE;
}

}  // namespace credo::freenect
