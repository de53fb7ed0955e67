#include "graph/duration_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace credo {
namespace {

constexpr double kFirstBinMs = 1e-3;
constexpr double kRatio = 1.01;
constexpr std::size_t kBins = 2084;  // kFirstBinMs * kRatio^2083 is 1000 s

}  // namespace

DurationHistogram::DurationHistogram() : bins_(kBins, 0) {}

void DurationHistogram::add(std::chrono::nanoseconds duration) {
  double const ms = std::max(0.0, static_cast<double>(duration.count()) * 1e-6);
  double const position = ms <= kFirstBinMs ? 0.0 : std::log(ms / kFirstBinMs) / std::log(kRatio);
  ++bins_[std::min(kBins - 1, static_cast<std::size_t>(std::ceil(position)))];
  ++count_;
  max_ms_ = std::max(max_ms_, ms);
}

double DurationHistogram::quantile_ms(double q) const {
  auto const wanted = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    seen += bins_[bin];
    if (seen > 0 && seen >= wanted) {
      return std::min(max_ms_, kFirstBinMs * std::pow(kRatio, static_cast<double>(bin)));
    }
  }
  return 0.0;
}

DurationQuantiles DurationHistogram::quantiles() const {
  return {count_, quantile_ms(0.5), quantile_ms(0.95), quantile_ms(0.99), max_ms_};
}

}  // namespace credo
