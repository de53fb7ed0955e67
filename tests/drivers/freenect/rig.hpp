#pragma once

#include <OpenNI.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "support/fake_usb/fake_usb.hpp"

namespace credo::test {

inline constexpr int kPixels = 640 * 480;
/// What a loaded machine may take for anything.
inline constexpr auto kPatience = std::chrono::seconds(20);

/// Three images each, with all depths that there are, none, and the false ones.
fake_usb::Images striped_images();
fake_usb::Kinect kinect(std::string const& serial);
std::string uri_of(std::string const& serial);

/// OpenNI's last error.
std::string openni_error();

/// What OpenNI tells of devices: "+uri" came, "-uri" went.
class Events : public openni::OpenNI::DeviceConnectedListener,
               public openni::OpenNI::DeviceDisconnectedListener {
public:
  Events();
  Events(Events const&) = delete;
  Events& operator=(Events const&) = delete;
  Events(Events&&) = delete;
  Events& operator=(Events&&) = delete;
  ~Events() override;

  void onDeviceConnected(openni::DeviceInfo const* info) override;
  void onDeviceDisconnected(openni::DeviceInfo const* info) override;
  /// Whether it has come, or comes in time.
  bool wait_for(std::string const& event);
  std::vector<std::string> all();

private:
  void add(std::string const& event);

  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<std::string> events_;
};

/// An image as it came out of OpenNI2, without padding.
struct Image {
  std::uint64_t stamp_us = 0;
  int index = 0;
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] std::vector<std::uint16_t> depths_mm() const;
};

/// An open device with its streams, as a client has it.
struct Client {
  openni::Device device;
  openni::VideoStream depth;
  openni::VideoStream color;

  explicit Client(std::string const& serial);
  Client(Client const&) = delete;
  Client& operator=(Client const&) = delete;
  Client(Client&&) = delete;
  Client& operator=(Client&&) = delete;
  ~Client() { close(); }
  void close();
};

/// The next image of a stream; none where none comes in time.
std::optional<Image> read(openni::VideoStream& stream,
                          std::chrono::milliseconds patience = kPatience);
int property(openni::VideoStream const& stream, int id);
/// Which of three images a depth stamp is of, and a colour stamp.
std::size_t image_at(std::uint64_t stamp_us);

/// Starts OpenNI2 with these Kinects plugged in.
class Rig {
public:
  explicit Rig(std::vector<fake_usb::Kinect> kinects);
  Rig(Rig const&) = delete;
  Rig& operator=(Rig const&) = delete;
  Rig(Rig&&) = delete;
  Rig& operator=(Rig&&) = delete;
  ~Rig();

private:
  std::vector<std::string> serials_;
};

/// What libfreenect alone makes of the streams of the one Kinect there is: by number of the image,
/// three of each. `depth_format` is libfreenect's.
struct PlainImages {
  std::vector<std::vector<std::uint16_t>> depths_mm;
  std::vector<std::vector<std::uint8_t>> colors;
};
PlainImages plain_images(int depth_format);

}  // namespace credo::test
