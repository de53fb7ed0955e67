#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/run_metrics.hpp"

namespace credo {

/// Durations counted in bins of 1 % width, so that percentiles of any number of samples take a
/// fixed 17 KB. From 1 us to about 1000 s; what lies outside counts in the end bins. Not
/// thread-safe.
class DurationHistogram {
public:
  DurationHistogram();

  /// A negative duration counts as 0.
  void add(std::chrono::nanoseconds duration);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Exact; 0 without samples.
  [[nodiscard]] double max_ms() const { return max_ms_; }
  /// The smallest duration that at least a fraction q in (0, 1] of the samples does not exceed,
  /// within 1 % (1 us at the least); never above max_ms(), 0 without samples.
  [[nodiscard]] double quantile_ms(double q) const;
  [[nodiscard]] DurationQuantiles quantiles() const;

private:
  std::vector<std::uint64_t> bins_;
  std::uint64_t count_ = 0;
  double max_ms_ = 0.0;
};

}  // namespace credo
