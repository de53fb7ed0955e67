#include "drivers/freenect/bus.hpp"

#include <algorithm>

namespace credo::freenect {

Bus::Bus() {
  if (freenect_init(&context_, nullptr) < 0) {
    context_ = nullptr;
    return;
  }
  freenect_set_log_callback(context_, [](freenect_context*, freenect_loglevel, char const*) {});
}

Bus::~Bus() {
  if (context_ != nullptr) {
    freenect_shutdown(context_);
  }
}

Presence Bus::look() {
  return context_ == nullptr ? Presence{} : look_at_bus(context_);
}

Presence look_at_bus(freenect_context* context) {
  Presence presence;
  int const plugged = freenect_num_devices(context);
  freenect_device_attributes* list = nullptr;
  freenect_list_device_attributes(context, &list);
  for (freenect_device_attributes const* one = list; one != nullptr; one = one->next) {
    presence.serials.emplace_back(one->camera_serial);
  }
  freenect_free_device_attributes(list);
  // It lists those that it could open, without a word on the others.
  presence.unreadable = std::max(0, plugged - static_cast<int>(presence.serials.size()));
  return presence;
}

}  // namespace credo::freenect
