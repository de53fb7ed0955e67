#include "drivers/freenect/driver.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "drivers/freenect/report.hpp"

namespace credo::freenect {
namespace {

constexpr std::string_view kScheme = "freenect://";

OniDeviceInfo info_of(std::string const& serial) {
  OniDeviceInfo info{};
  std::string const uri = std::string(kScheme) + serial;
  std::strncpy(info.uri, uri.c_str(), ONI_MAX_STR - 1);
  std::strncpy(info.vendor, "Microsoft", ONI_MAX_STR - 1);
  std::strncpy(info.name, "Kinect", ONI_MAX_STR - 1);
  info.usbVendorId = 0x045E;
  info.usbProductId = 0x02AE;
  return info;
}

std::string no_permission(int unreadable) {
  return std::to_string(unreadable) +
         " Kinect(s) plugged in may not be read: give the right by a udev rule for USB 045e:02ae";
}

}  // namespace

OniStatus Driver::initialize(oni::driver::DeviceConnectedCallback connected,
                             oni::driver::DeviceDisconnectedCallback disconnected,
                             oni::driver::DeviceStateChangedCallback state_changed, void* cookie) {
  DriverBase::initialize(connected, disconnected, state_changed, cookie);
  look();
  // Who hears that a Kinect is gone may close it: no thread of a Kinect may tell.
  monitor_.start([this] { report_lost(); }, [this] { look(); });
  return ONI_STATUS_OK;
}

void Driver::look() {
  Presence const now = bus_.look();
  PresenceChanges changes;
  {
    std::scoped_lock const lock(mutex_);
    changes = present_.update(now);
    unreadable_ = now.unreadable;
    for (Opened& opened : open_) {
      if (std::ranges::find(changes.went, opened.device->serial()) != changes.went.end()) {
        opened.device->kinect().set_lost();
        opened.told_gone = true;
      }
    }
  }
  tell(changes);
}

void Driver::report_lost() {
  PresenceChanges changes;
  {
    std::scoped_lock const lock(mutex_);
    for (Opened& opened : open_) {
      if (opened.device->kinect().lost() && !opened.told_gone) {
        opened.told_gone = true;
        present_.forget(opened.device->serial());
        changes.went.push_back(opened.device->serial());
      }
    }
  }
  tell(changes);
}

void Driver::tell(PresenceChanges const& changes) {
  for (std::string const& serial : changes.went) {
    OniDeviceInfo const info = info_of(serial);
    deviceDisconnected(&info);
  }
  for (std::string const& serial : changes.came) {
    OniDeviceInfo const info = info_of(serial);
    deviceConnected(&info);
  }
  if (changes.unreadable.value_or(0) > 0) {
    log_warning(getServices(), no_permission(*changes.unreadable));
  }
}

oni::driver::DeviceBase* Driver::deviceOpen(char const* uri, char const* /*mode*/) {
  KinectDevice* device = nullptr;
  reported(getServices(), [&] {
    device = new KinectDevice(std::string(uri).substr(kScheme.size()), getServices());
    std::scoped_lock const lock(mutex_);
    open_.push_back({device});
  });
  return device;
}

void Driver::deviceClose(oni::driver::DeviceBase* device) {
  {
    std::scoped_lock const lock(mutex_);
    std::erase_if(open_, [&](Opened const& opened) { return opened.device == device; });
  }
  std::unique_ptr<KinectDevice> kinect(static_cast<KinectDevice*>(device));
  kinect->kinect().close();
  if (kinect->has_streams()) {
    std::scoped_lock const lock(mutex_);
    closed_.push_back(std::move(kinect));
  }
}

void Driver::shutdown() {
  monitor_.stop();
}

OniStatus Driver::tryDevice(char const* uri) {
  if (std::string_view(uri).starts_with(kScheme)) {
    std::scoped_lock const lock(mutex_);
    append_error(getServices(), std::string(uri) +
                                    ": no Kinect of this serial number is plugged in" +
                                    (unreadable_ > 0 ? "; " + no_permission(unreadable_) : ""));
  }
  return ONI_STATUS_NO_DEVICE;
}

// OpenNI pairs what comes; null would be a refusal.
void* Driver::enableFrameSync(oni::driver::StreamBase** /*streams*/, int /*count*/) {
  return this;
}

void Driver::disableFrameSync(void* /*group*/) {}

}  // namespace credo::freenect

ONI_EXPORT_DRIVER(credo::freenect::Driver)
