#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "drivers/virtual/sensor_images.hpp"

namespace credo {

/// Images decoded before they are needed, by a thread of its own, within a bound of memory: all of
/// them where they fit, and each once; else those of the positions to come.
class ImageStore {
public:
  /// Which image is shown at a position, as SensorSchedule::image_at.
  using Order = std::function<std::optional<std::size_t>(std::int64_t position)>;

  /// `dataset` must outlive the store. It holds 8 images at least. What cannot be read is told
  /// through `complain`, on the store's thread.
  ImageStore(SensorDataset const& dataset, std::size_t budget_mb, Order order,
             std::function<void(std::string const&)> complain);
  ImageStore(ImageStore const&) = delete;
  ImageStore& operator=(ImageStore const&) = delete;
  ImageStore(ImageStore&&) = delete;
  ImageStore& operator=(ImageStore&&) = delete;
  ~ImageStore() = default;

  /// Waits until what is to come has been decoded as far ahead as it may.
  void wait_until_ahead();
  /// The images at a position, waited for where they are not decoded yet; null where they cannot be
  /// read, at the end, and on `stop`. Positions may be asked for by several threads, a little
  /// apart.
  SensorImagesPtr at(std::int64_t position, std::stop_token const& stop);
  /// Images that are held now.
  [[nodiscard]] std::size_t held() const;

private:
  void decode_ahead(std::stop_token const& stop);
  /// The first position that need not be decoded yet.
  [[nodiscard]] std::int64_t end() const;
  [[nodiscard]] std::optional<std::size_t> next_missing() const;
  void forget_what_passed();

  SensorDataset const& dataset_;
  std::size_t capacity_;
  Order order_;
  std::function<void(std::string const&)> complain_;

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::map<std::size_t, SensorImagesPtr> images_;  // null: cannot be read
  std::int64_t newest_ = 0;
  bool ahead_ = false;
  std::jthread thread_;
};

}  // namespace credo
