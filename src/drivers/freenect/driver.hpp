#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/freenect/bus.hpp"
#include "drivers/freenect/device.hpp"
#include "drivers/freenect/monitor.hpp"
#include "drivers/freenect/presence.hpp"
#include "drivers/openni_driver_api.hpp"

namespace credo::freenect {

/// The driver: tells OpenNI2 which Kinects there are, and opens them. A Kinect is
/// `freenect://<serial>`.
class Driver : public oni::driver::DriverBase {
public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}
  Driver(Driver const&) = delete;
  Driver& operator=(Driver const&) = delete;
  Driver(Driver&&) = delete;
  Driver& operator=(Driver&&) = delete;
  ~Driver() override = default;

  /// Looks for Kinects, and from then on in a thread of its own. Never fails: without its only
  /// driver OpenNI2 would not start at all.
  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override;
  oni::driver::DeviceBase* deviceOpen(char const* uri, char const* mode) override;
  void deviceClose(oni::driver::DeviceBase* device) override;
  void shutdown() override;
  OniStatus tryDevice(char const* uri) override;
  void* enableFrameSync(oni::driver::StreamBase** streams, int count) override;
  void disableFrameSync(void* group) override;

private:
  struct Opened {
    KinectDevice* device = nullptr;
    /// OpenNI has been told that it is gone.
    bool told_gone = false;
  };

  void look();
  void report_lost();
  void tell(PresenceChanges const& changes);

  Bus bus_;
  /// Held for what follows it, and never while OpenNI is called.
  std::mutex mutex_;
  std::vector<Opened> open_;
  /// Closed, but OpenNI may still stop their streams: kept as long as the driver.
  std::vector<std::unique_ptr<KinectDevice>> closed_;
  PresenceRecord present_;
  int unreadable_ = 0;
  Monitor monitor_;
};

}  // namespace credo::freenect
