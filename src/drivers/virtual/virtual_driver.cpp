// The module that OpenNI2 loads: sensors of the script that CREDO_VIRTUAL_SENSOR names.
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "drivers/openni_driver_api.hpp"
#include "drivers/virtual/sensor_script.hpp"
#include "drivers/virtual/virtual_device.hpp"
#include "drivers/virtual/virtual_sensor.hpp"

namespace credo {
namespace {

constexpr char const* kScriptVariable = "CREDO_VIRTUAL_SENSOR";
constexpr auto kWatchEvery = std::chrono::milliseconds(10);

OniDeviceInfo info_of(VirtualSensor const& sensor) {
  OniDeviceInfo info{};
  auto const write = [](std::string const& text, std::span<char> field) {
    text.copy(field.data(), field.size() - 1);  // the rest is 0
  };
  write(sensor.uri(), info.uri);
  write("Credo", info.vendor);
  write("Virtual sensor", info.name);
  return info;
}

/// A sensor, and what OpenNI2 was last told of it.
struct ListedSensor {
  explicit ListedSensor(SensorScript script) : sensor(std::move(script)), info(info_of(sensor)) {}
  VirtualSensor sensor;
  OniDeviceInfo info;
  PlugState told;
};

}  // namespace

class VirtualDriver final : public oni::driver::DriverBase {
public:
  explicit VirtualDriver(OniDriverServices* services) : DriverBase(services) {}
  VirtualDriver(VirtualDriver const&) = delete;
  VirtualDriver& operator=(VirtualDriver const&) = delete;
  VirtualDriver(VirtualDriver&&) = delete;
  VirtualDriver& operator=(VirtualDriver&&) = delete;
  ~VirtualDriver() override = default;

  /// Always OK: were it the only driver, an error would keep OpenNI2 from starting at all.
  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    char const* const script = std::getenv(kScriptVariable);  // NOLINT(concurrency-mt-unsafe)
    if (script == nullptr || *script == '\0') {
      trouble_ = std::string(kScriptVariable) + " names no script; see docs/virtual-sensor.md";
      return ONI_STATUS_OK;
    }
    try {
      if (!std::filesystem::path(script).is_absolute()) {
        throw InputError(std::string(script) +
                         ": must be an absolute path: OpenNI2 starts drivers in their own folder");
      }
      for (SensorScript& sensor : read_sensor_script(script)) {
        sensors_.push_back(std::make_unique<ListedSensor>(std::move(sensor)));
      }
    } catch (InputError const& error) {
      trouble_ = error.what();
      // Whoever opens just any sensor would not hear of it.
      std::fputs((std::string(kScriptVariable) + ": " + trouble_ + "\n").c_str(), stderr);
      return ONI_STATUS_OK;
    }
    for (auto const& listed : sensors_) {
      deviceConnected(&listed->info);
    }
    watcher_ = std::jthread([this](std::stop_token const& stop) { watch(stop); });
    return ONI_STATUS_OK;
  }

  void shutdown() override {
    watcher_ = {};
    devices_.clear();
    sensors_.clear();
  }

  /// Asked for what is on no list; never opens it, but says why not.
  OniStatus tryDevice(char const* uri) override {
    std::string const asked = uri != nullptr ? uri : "";
    if (asked.starts_with("virtual:")) {
      std::string known;
      for (auto const& listed : sensors_) {
        known += (known.empty() ? "" : ", ") + listed->sensor.uri() +
                 (listed->sensor.plug_state().plugged ? "" : " (unplugged)");
      }
      say(asked + ": " + (trouble_.empty() ? "is not plugged in; known are " + known : trouble_));
    }
    return ONI_STATUS_ERROR;
  }

  oni::driver::DeviceBase* deviceOpen(char const* uri, char const* /*mode*/) override {
    auto const found = std::ranges::find_if(
        sensors_, [&](auto const& listed) { return listed->sensor.uri() == uri; });
    try {
      if (found == sensors_.end() || !(*found)->sensor.plug_state().plugged) {
        throw InputError(std::string(uri) + ": is not plugged in");
      }
      (*found)->sensor.load();
      std::scoped_lock const lock(mutex_);
      devices_.push_back(std::make_unique<VirtualDevice>((*found)->sensor));
      return devices_.back().get();
    } catch (std::exception const& error) {
      say(error.what());
      return nullptr;
    }
  }

  void deviceClose(oni::driver::DeviceBase* device) override {
    static_cast<VirtualDevice*>(device)->close();
  }

  void* enableFrameSync(oni::driver::StreamBase** /*streams*/, int /*count*/) override {
    return this;
  }

private:
  /// OpenNI2 goes on right behind it.
  void say(std::string const& text) {
    getServices().errorLoggerAppend("%s. ", text.c_str());  // NOLINT(*-vararg): OpenNI2's way
  }

  /// Tells of sensors that come and go. Holds no lock while it does: listeners may close devices.
  void watch(std::stop_token const& stop) {
    std::mutex mutex;
    std::condition_variable_any never;
    while (!stop.stop_requested()) {
      for (auto const& listed : sensors_) {
        PlugState const now = listed->sensor.plug_state();
        if (listed->told.plugged && now != listed->told) {
          deviceDisconnected(&listed->info);
          listed->told.plugged = false;
        }
        if (now.plugged && !listed->told.plugged) {
          deviceConnected(&listed->info);
        }
        listed->told = now;
      }
      std::unique_lock lock(mutex);
      never.wait_for(lock, stop, kWatchEvery, [] { return false; });
    }
  }

  std::vector<std::unique_ptr<ListedSensor>> sensors_;
  std::mutex mutex_;
  /// All that were ever opened.
  std::vector<std::unique_ptr<VirtualDevice>> devices_;
  /// Why there are no sensors.
  std::string trouble_;
  std::jthread watcher_;
};

}  // namespace credo

ONI_EXPORT_DRIVER(credo::VirtualDriver)
