#pragma once

#include <OpenNI.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "drivers/virtual/plain_dataset.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {

/// One image as OpenNI2 handed it over.
struct Received {
  bool is_depth = false;
  int index = 0;
  std::uint64_t stamp_us = 0;
  int width = 0;
  int height = 0;
  int bytes = 0;
  /// All that the size promises.
  std::vector<unsigned char> data;
};

template <typename T>
std::vector<unsigned char> bytes_of(Grid<T> const& image) {
  auto const* const data = reinterpret_cast<unsigned char const*>(image.data());
  return {data, data + image.size() * sizeof(T)};
}

/// A client of OpenNI2 and of nothing of ours; one thread that reads, waits and stops.
class Client {
public:
  explicit Client(std::string const& name) {
    status_ = device_.open(("virtual://" + name).c_str());
    if (status_ == openni::STATUS_OK) {
      EXPECT_EQ(depth_.create(device_, openni::SENSOR_DEPTH), openni::STATUS_OK);
      EXPECT_EQ(color_.create(device_, openni::SENSOR_COLOR), openni::STATUS_OK);
    }
  }
  Client(Client const&) = delete;
  Client& operator=(Client const&) = delete;
  Client(Client&&) = delete;
  Client& operator=(Client&&) = delete;
  ~Client() {
    depth_.stop();
    color_.stop();
    depth_.destroy();
    color_.destroy();
    device_.close();
  }

  [[nodiscard]] openni::Status status() const { return status_; }
  openni::Device& device() { return device_; }
  openni::VideoStream& depth() { return depth_; }
  openni::VideoStream& color() { return color_; }

  void register_depth() {
    EXPECT_EQ(device_.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR),
              openni::STATUS_OK);
    EXPECT_EQ(device_.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  }
  void start() {
    EXPECT_EQ(depth_.start(), openni::STATUS_OK);
    EXPECT_EQ(color_.start(), openni::STATUS_OK);
  }
  /// What comes until either stream is at tick `last` or beyond, or nothing for `silence_ms`.
  std::vector<Received> receive_until(int last, int silence_ms = 10'000) {
    std::vector<Received> all;
    while (all.empty() || all.back().index < last) {
      std::array<openni::VideoStream*, 2> streams = {&depth_, &color_};
      int which = -1;
      openni::VideoFrameRef frame;
      if (openni::OpenNI::waitForAnyStream(streams.data(), 2, &which, silence_ms) !=
              openni::STATUS_OK ||
          streams.at(static_cast<std::size_t>(which))->readFrame(&frame) != openni::STATUS_OK) {
        break;
      }
      auto const* const data = static_cast<unsigned char const*>(frame.getData());
      int const promised = frame.getStrideInBytes() * frame.getHeight();
      all.push_back({which == 0,
                     frame.getFrameIndex(),
                     frame.getTimestamp(),
                     frame.getWidth(),
                     frame.getHeight(),
                     frame.getDataSize(),
                     {data, data + promised}});
    }
    return all;
  }

private:
  openni::Device device_;
  openni::Status status_ = openni::STATUS_ERROR;
  openni::VideoStream depth_;
  openni::VideoStream color_;
};

/// OpenNI2 with the sensors of a script; the datasets `a` and `b` lie beside it.
class VirtualDriver : public ::testing::Test {
protected:
  static constexpr std::size_t kImages = 12;

  void SetUp() override {
    write_dataset(folder_ / "a", kImages);
    write_dataset(folder_ / "b", 1);
  }
  void TearDown() override { openni::OpenNI::shutdown(); }

  void start_openni(std::string const& script) {
    write_text(folder_ / "s.json", script);
    start_with(folder_ / "s.json");
  }
  static void start_with(std::filesystem::path const& script) {
    ::setenv("CREDO_VIRTUAL_SENSOR", script.c_str(), 1);
    ASSERT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK);
  }
  /// One sensor `a` with one fault.
  void start_with_fault(std::string const& fault, std::string const& keys = "") {
    start_openni(R"({"sensors": [{"name": "a", "dataset": "a", )" + keys + R"("faults": [)" +
                 fault + "]}]}");
  }
  /// What the client gets of sensor `a` until tick `last`, depth registered.
  static std::vector<Received> received_until(int last) {
    Client client("a");
    EXPECT_EQ(client.status(), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
    client.register_depth();
    client.start();
    return client.receive_until(last);
  }
  static std::vector<unsigned char> pixels_of(Received const& image, std::size_t images = kImages) {
    std::size_t const shown = static_cast<std::size_t>(image.index) % images;
    return image.is_depth ? bytes_of(depth_of(shown)) : bytes_of(color_of(shown));
  }
  static std::uint64_t usual_stamp_us(Received const& image) {
    return static_cast<std::uint64_t>(1'000'000 + std::int64_t{image.index} * 1'000'000 / 30);
  }

  TempFolder folder_;
};

/// What OpenNI2 says of a sensor that it does not open.
inline std::string error_of(std::string const& uri) {
  openni::Device device;
  EXPECT_NE(device.open(uri.c_str()), openni::STATUS_OK);
  return openni::OpenNI::getExtendedError();
}

/// How many there are of a stream from tick `first` to before `end`.
inline int count(std::vector<Received> const& all, bool depth, int first, int end) {
  int found = 0;
  for (Received const& image : all) {
    found += image.is_depth == depth && image.index >= first && image.index < end ? 1 : 0;
  }
  return found;
}

}  // namespace credo::test
