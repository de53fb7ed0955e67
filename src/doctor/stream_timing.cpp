#include "doctor/stream_timing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace credo {
namespace {

constexpr double kNs = 1e-9;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// How much later an image came than it was taken, up to a constant.
double delay_s(ImageTime const& image) {
  return seconds(image.arrival.time_since_epoch()) - kNs * static_cast<double>(image.stamp_ns);
}

ImageTime const& least_delayed(std::span<ImageTime const> images) {
  return *std::ranges::min_element(images, {}, delay_s);
}

/// Colour stamp - depth stamp of the nearest in time. There is one.
double offset_ms(ImageTime const& depth, std::vector<ImageTime> const& color) {
  auto const apart = [&](ImageTime const& image) {
    return std::abs(image.stamp_ns - depth.stamp_ns);
  };
  ImageTime const& nearest = *std::ranges::min_element(color, {}, apart);
  return 1e-6 * static_cast<double>(nearest.stamp_ns - depth.stamp_ns);
}

}  // namespace

StreamTiming timing_of(std::vector<ImageTime> const& images) {
  StreamTiming timing;
  timing.images = static_cast<int>(images.size());
  for (std::size_t i = 1; i < images.size(); ++i) {
    timing.lost += std::max(0, images[i].number - images[i - 1].number - 1);
    timing.longest_gap_s =
        std::max(timing.longest_gap_s, seconds(images[i].arrival - images[i - 1].arrival));
  }
  if (images.size() > 1) {
    double const intervals = timing.images - 1;
    auto const stamps_ns = static_cast<double>(images.back().stamp_ns - images.front().stamp_ns);
    double const arrivals_s = seconds(images.back().arrival - images.front().arrival);
    timing.rate_by_stamp_hz = stamps_ns > 0.0 ? intervals / (kNs * stamps_ns) : 0.0;
    timing.rate_by_arrival_hz = arrivals_s > 0.0 ? intervals / arrivals_s : 0.0;
  }
  return timing;
}

std::optional<StreamSync> sync_of(std::vector<ImageTime> const& depth,
                                  std::vector<ImageTime> const& color, double rate_hz) {
  if (color.empty() || !(rate_hz > 0.0)) {
    return std::nullopt;
  }
  double const near_ms = 500.0 / rate_hz;
  // A stream that starts later or ends earlier is another matter.
  double const margin_ns = 1e6 * near_ms;
  auto const first_ns = static_cast<double>(color.front().stamp_ns) - margin_ns;
  auto const last_ns = static_cast<double>(color.back().stamp_ns) + margin_ns;
  std::vector<double> offsets_ms;
  for (ImageTime const& image : depth) {
    auto const stamp_ns = static_cast<double>(image.stamp_ns);
    if (stamp_ns >= first_ns && stamp_ns <= last_ns) {
      offsets_ms.push_back(offset_ms(image, color));
    }
  }
  if (offsets_ms.empty()) {
    return std::nullopt;
  }
  StreamSync sync;
  auto const paired =
      std::ranges::count_if(offsets_ms, [&](double ms) { return std::abs(ms) <= near_ms; });
  sync.paired_share = static_cast<double>(paired) / static_cast<double>(offsets_ms.size());
  sync.worst_ms = *std::ranges::max_element(offsets_ms, {}, [](double ms) { return std::abs(ms); });
  auto const middle = offsets_ms.begin() + static_cast<std::ptrdiff_t>(offsets_ms.size() / 2);
  std::ranges::nth_element(offsets_ms, middle);
  sync.median_ms = *middle;
  return sync;
}

std::optional<ClockDrift> drift_of(std::vector<ImageTime> const& images) {
  constexpr std::size_t kLeast = 9;
  constexpr double kLeast_s = 1.0;
  if (images.size() < kLeast ||
      seconds(images.back().arrival - images.front().arrival) < kLeast_s) {
    return std::nullopt;
  }
  std::size_t const third = images.size() / 3;
  ImageTime const& before = least_delayed(std::span(images).first(third));
  ImageTime const& after = least_delayed(std::span(images).last(third));
  double const change_s = delay_s(before) - delay_s(after);
  return ClockDrift{.ppm = 1e6 * change_s / seconds(after.arrival - before.arrival),
                    .change_ms = 1e3 * change_s};
}

}  // namespace credo
