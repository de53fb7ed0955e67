#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "drivers/virtual/image_store.hpp"
#include "drivers/virtual/sensor_images.hpp"
#include "drivers/virtual/sensor_schedule.hpp"
#include "drivers/virtual/sensor_script.hpp"

namespace credo {

/// What of a sensor outlives its being opened and closed: its script, its images, its time.
class VirtualSensor {
public:
  using Clock = std::chrono::steady_clock;

  explicit VirtualSensor(SensorScript script) : script_(std::move(script)) {}

  [[nodiscard]] SensorScript const& script() const { return script_; }
  [[nodiscard]] std::string uri() const { return "virtual://" + script_.name; }

  /// At its first call reads the dataset, as far as that fits; throws InputError where that cannot
  /// be. What follows may be called after it.
  void load();
  [[nodiscard]] SensorDataset const& dataset() const { return *dataset_; }
  [[nodiscard]] SensorSchedule const& schedule() const { return *schedule_; }
  [[nodiscard]] ImageStore& store() const { return *store_; }

  /// Starts its time, unless it runs already; the time now.
  std::int64_t start_ns();
  /// The steady clock at a time of the sensor, which must have been started.
  [[nodiscard]] Clock::time_point due(std::int64_t time_ns) const;
  [[nodiscard]] std::int64_t now_ns() const;
  /// Plugged in until its time starts.
  [[nodiscard]] PlugState plug_state() const;

private:
  SensorScript script_;
  std::mutex loading_;
  std::optional<SensorDataset> dataset_;
  std::optional<SensorSchedule> schedule_;
  std::unique_ptr<ImageStore> store_;

  mutable std::mutex mutex_;
  std::optional<Clock::time_point> started_;
};

}  // namespace credo
