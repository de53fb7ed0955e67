#pragma once

#include <cstdint>
#include <optional>

namespace credo {

/// A mean that grows.
class Mean {
public:
  void add(double value) {
    sum_ += value;
    ++count_;
  }
  [[nodiscard]] std::optional<double> value() const {
    return count_ > 0 ? std::optional(sum_ / static_cast<double>(count_)) : std::nullopt;
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

private:
  double sum_ = 0.0;
  std::uint64_t count_ = 0;
};

}  // namespace credo
