#include "drivers/virtual/virtual_sensor.hpp"

#include <cstdio>

#include "core/error.hpp"

namespace credo {

void VirtualSensor::load() {
  std::scoped_lock const lock(loading_);
  if (store_ != nullptr) {
    return;
  }
  auto const complain = [uri = uri()](std::string const& what) {
    std::fputs((uri + ": " + what + "\n").c_str(), stderr);
  };
  try {
    dataset_.emplace(script_.dataset);
  } catch (InputError const& error) {
    throw InputError(uri() + ": " + error.what());
  }
  for (std::string const& warning : dataset_->warnings()) {
    complain(warning);
  }
  schedule_.emplace(script_, dataset_->count());
  store_ = std::make_unique<ImageStore>(
      *dataset_, script_.cache_mb,
      [this](std::int64_t position) { return schedule_->image_at(position); }, complain);
  store_->wait_until_ahead();
}

std::int64_t VirtualSensor::start_ns() {
  std::scoped_lock const lock(mutex_);
  if (!started_) {
    started_ = Clock::now();
    return 0;
  }
  return std::chrono::nanoseconds(Clock::now() - *started_).count();
}

VirtualSensor::Clock::time_point VirtualSensor::due(std::int64_t time_ns) const {
  std::scoped_lock const lock(mutex_);
  return started_.value() + std::chrono::nanoseconds(time_ns);
}

std::int64_t VirtualSensor::now_ns() const {
  return std::chrono::nanoseconds(Clock::now() - due(0)).count();
}

PlugState VirtualSensor::plug_state() const {
  std::scoped_lock const lock(mutex_);
  return started_
             ? schedule_->plug_state(std::chrono::nanoseconds(Clock::now() - *started_).count())
             : PlugState{};
}

}  // namespace credo
