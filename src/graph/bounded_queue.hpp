#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

namespace credo {

/// What an edge does with one frame too many.
enum class Overflow : std::uint8_t {
  /// The writer waits until the reader has taken one: nothing is lost (replay).
  kWait,
  /// The oldest waiting frame gives way to the newest: nothing waits (live).
  kDropOldest,
};

/// What an edge saw of a run.
struct QueueStats {
  std::size_t capacity = 0;
  /// Most values that ever lay in it at once; never above the capacity.
  std::size_t peak = 0;
  std::uint64_t dropped = 0;
};

/// A first-in first-out queue between one writer and one reader that never holds more than
/// `capacity` values.
///
/// Writing takes two steps, so that no worker ever blocks on a full queue: `try_reserve` before the
/// value is made, `push` once it is there. Under kDropOldest a reservation is always granted and
/// `push` makes room by dropping. Reservations count as room taken, so a granted one never fails.
/// All members may be called from any thread.
template <typename T>
class BoundedQueue {
public:
  /// Called when `dropped` gives way, with the value that is then the oldest; under the queue's
  /// lock.
  using Inherit = std::function<void(T dropped, T& next)>;

  /// Throws std::logic_error for a capacity of 0.
  BoundedQueue(std::size_t capacity, Overflow overflow, Inherit inherit)
      : overflow_(overflow), inherit_(std::move(inherit)) {
    if (capacity == 0) {
      throw std::logic_error("BoundedQueue: capacity 0");
    }
    stats_.capacity = capacity;
  }

  /// Sets room for one value aside; false where there is none.
  [[nodiscard]] bool try_reserve() {
    std::scoped_lock const lock(mutex_);
    return reserve_locked();
  }

  /// Like try_reserve, but waits. Only for a thread that may block: never a worker.
  void wait_and_reserve() {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return reserve_locked(); });
  }

  /// Gives a reservation back unused.
  void release() {
    {
      std::scoped_lock const lock(mutex_);
      use_reservation_locked();
    }
    room_.notify_one();
  }

  /// Appends a value into room reserved before; without a reservation throws std::logic_error.
  void push(T value) {
    std::scoped_lock const lock(mutex_);
    use_reservation_locked();
    if (values_.size() == stats_.capacity) {
      T dropped = std::move(values_.front());
      values_.pop_front();
      ++stats_.dropped;
      inherit_(std::move(dropped), values_.empty() ? value : values_.front());
    }
    values_.push_back(std::move(value));
    stats_.peak = std::max(stats_.peak, values_.size());
  }

  /// The oldest value if there is one and `ready(value)` holds.
  template <typename Ready>
  [[nodiscard]] std::optional<T> try_pop(Ready const& ready) {
    std::optional<T> value;
    {
      std::scoped_lock const lock(mutex_);
      if (values_.empty() || !ready(std::as_const(values_.front()))) {
        return std::nullopt;
      }
      value.emplace(std::move(values_.front()));
      values_.pop_front();
    }
    room_.notify_one();
    return value;
  }

  [[nodiscard]] QueueStats stats() const {
    std::scoped_lock const lock(mutex_);
    return stats_;
  }

private:
  bool reserve_locked() {
    if (overflow_ == Overflow::kWait && values_.size() + reserved_ >= stats_.capacity) {
      return false;
    }
    ++reserved_;
    return true;
  }

  void use_reservation_locked() {
    if (reserved_ == 0) {
      throw std::logic_error("BoundedQueue: no room was reserved");
    }
    --reserved_;
  }

  mutable std::mutex mutex_;
  std::condition_variable room_;
  std::deque<T> values_;
  std::size_t reserved_ = 0;
  Overflow overflow_;
  Inherit inherit_;
  QueueStats stats_;
};

}  // namespace credo
