#include "drivers/freenect/rig.hpp"

#include <gtest/gtest.h>
#include <libfreenect.h>
#include <sys/time.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace credo::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kImages = 3;

}  // namespace

fake_usb::Images striped_images() {
  fake_usb::Images images;
  for (int i = 0; i < static_cast<int>(kImages); ++i) {
    std::vector<std::uint16_t> depth;
    std::vector<std::uint8_t> color;
    for (int p = 0; p < kPixels; ++p) {
      depth.push_back(
          static_cast<std::uint16_t>(p % 11 == i ? 2047 : 400 + (p * 7 + i * 131) % 800));
      color.push_back(static_cast<std::uint8_t>(p * 5 + p / 640 * 3 + i * 37));
    }
    images.depth_raw.push_back(std::move(depth));
    images.color_bayer.push_back(std::move(color));
  }
  return images;
}

fake_usb::Kinect kinect(std::string const& serial) {
  return {.serial = serial, .images = striped_images()};
}

std::string uri_of(std::string const& serial) {
  return "freenect://" + serial;
}

std::string openni_error() {
  return openni::OpenNI::getExtendedError();
}

Events::Events() {
  openni::OpenNI::addDeviceConnectedListener(this);
  openni::OpenNI::addDeviceDisconnectedListener(this);
}

Events::~Events() {
  openni::OpenNI::removeDeviceConnectedListener(this);
  openni::OpenNI::removeDeviceDisconnectedListener(this);
}

void Events::onDeviceConnected(openni::DeviceInfo const* info) {
  add(std::string("+") + info->getUri());
}

void Events::onDeviceDisconnected(openni::DeviceInfo const* info) {
  add(std::string("-") + info->getUri());
}

void Events::add(std::string const& event) {
  std::scoped_lock const lock(mutex_);
  events_.push_back(event);
  came_.notify_all();
}

bool Events::wait_for(std::string const& event) {
  std::unique_lock lock(mutex_);
  return came_.wait_for(lock, kPatience,
                        [&] { return std::ranges::find(events_, event) != events_.end(); });
}

std::vector<std::string> Events::all() {
  std::scoped_lock const lock(mutex_);
  return events_;
}

std::vector<std::uint16_t> Image::depths_mm() const {
  std::vector<std::uint16_t> depths(bytes.size() / 2);
  std::memcpy(depths.data(), bytes.data(), bytes.size());
  return depths;
}

Client::Client(std::string const& serial) {
  if (device.open(uri_of(serial).c_str()) != openni::STATUS_OK ||
      depth.create(device, openni::SENSOR_DEPTH) != openni::STATUS_OK ||
      color.create(device, openni::SENSOR_COLOR) != openni::STATUS_OK) {
    throw std::runtime_error(openni_error());
  }
}

void Client::close() {
  depth.destroy();
  color.destroy();
  device.close();
}

std::optional<Image> read(openni::VideoStream& stream, std::chrono::milliseconds patience) {
  openni::VideoStream* streams = &stream;
  int which = 0;
  openni::VideoFrameRef frame;
  if (openni::OpenNI::waitForAnyStream(&streams, 1, &which, static_cast<int>(patience.count())) !=
          openni::STATUS_OK ||
      stream.readFrame(&frame) != openni::STATUS_OK) {
    return std::nullopt;
  }
  auto const* const data = static_cast<std::uint8_t const*>(frame.getData());
  return Image{frame.getTimestamp(), frame.getFrameIndex(), {data, data + frame.getDataSize()}};
}

int property(openni::VideoStream const& stream, int id) {
  int value = -1;
  EXPECT_EQ(stream.getProperty<int>(id, &value), openni::STATUS_OK) << id;
  return value;
}

std::size_t image_at(std::uint64_t stamp_us) {
  // A frame is 33333.3 us; colour comes 500 us later.
  return (stamp_us * 3 + 1500) / 100'000 % kImages;
}

Rig::Rig(std::vector<fake_usb::Kinect> kinects) {
  for (fake_usb::Kinect& one : kinects) {
    serials_.push_back(one.serial);
    fake_usb::plug(std::move(one));
  }
  EXPECT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK) << openni_error();
}

Rig::~Rig() {
  openni::OpenNI::shutdown();
  for (std::string const& serial : serials_) {
    fake_usb::unplug(serial);
  }
}

PlainImages plain_images(int depth_format) {
  PlainImages images{std::vector<std::vector<std::uint16_t>>(kImages),
                     std::vector<std::vector<std::uint8_t>>(kImages)};
  freenect_context* context = nullptr;
  freenect_device* device = nullptr;
  freenect_init(&context, nullptr);
  freenect_select_subdevices(context, FREENECT_DEVICE_CAMERA);
  if (freenect_open_device(context, &device, 0) < 0) {
    throw std::runtime_error("libfreenect does not open the Kinect");
  }
  freenect_set_user(device, &images);
  freenect_set_depth_callback(device, [](freenect_device* from, void* data, std::uint32_t stamp) {
    auto const* const depths = static_cast<std::uint16_t const*>(data);
    static_cast<PlainImages*>(freenect_get_user(from))->depths_mm[image_at(stamp / 60)] = {
        depths, depths + kPixels};
  });
  freenect_set_video_callback(device, [](freenect_device* from, void* data, std::uint32_t stamp) {
    auto const* const rgb = static_cast<std::uint8_t const*>(data);
    static_cast<PlainImages*>(freenect_get_user(from))->colors[image_at(stamp / 60)] = {
        rgb, rgb + 3 * kPixels};
  });
  freenect_set_depth_mode(
      device, freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM,
                                       static_cast<freenect_depth_format>(depth_format)));
  freenect_start_depth(device);
  freenect_start_video(device);
  auto const empty = [](auto const& image) { return image.empty(); };
  auto const deadline = Clock::now() + kPatience;
  while (
      (std::ranges::any_of(images.depths_mm, empty) || std::ranges::any_of(images.colors, empty)) &&
      Clock::now() < deadline) {
    timeval timeout{.tv_sec = 0, .tv_usec = 20'000};
    freenect_process_events_timeout(context, &timeout);
  }
  freenect_stop_depth(device);
  freenect_stop_video(device);
  freenect_close_device(device);
  freenect_shutdown(context);
  return images;
}

}  // namespace credo::test
