#include "progress.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstddef>

namespace credo {
namespace {

std::ptrdiff_t seen_objects(BeliefState const& belief) {
  return std::ranges::count(belief.objects, Evidence::kSeen, &ObjectBelief::evidence);
}

void append_row(std::string& table, std::string const& name, DurationQuantiles const& times) {
  table += fmt::format("  {:<12}{:>8}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}\n", name, times.count,
                       times.p50_ms, times.p95_ms, times.p99_ms, times.max_ms);
}

}  // namespace

Progress::Progress(std::optional<std::int64_t> frame_count)
    : frame_count_(frame_count), last_shown_(Clock::now()) {}

void Progress::show(FrameResult const& result) {
  for (std::string const& line : detections_.told(*result.segmentation)) {
    finish();
    spdlog::warn(line);
  }
  ++frames_since_;
  if (!line_.is_due()) {
    return;
  }
  auto const now = Clock::now();
  auto const since = now - last_shown_;
  BeliefState const& belief = *result.belief;
  std::string const of = frame_count_.has_value() ? fmt::format("/{}", *frame_count_) : "";
  line_.show(
      fmt::format("frame {}{}  {:.1f} fps  {:.0f} ms  {}, {} walls, {} objects seen, {} stuff",
                  number(belief.frame) + 1, of,
                  static_cast<double>(frames_since_) / std::chrono::duration<double>(since).count(),
                  std::chrono::duration<double, std::milli>(now - result.captured).count(),
                  belief.floor.has_value() ? "floor" : "no floor", belief.walls.size(),
                  seen_objects(belief), belief.stuff.size()));
  last_shown_ = now;
  frames_since_ = 0;
}

std::string summary_table(RunMetrics const& metrics) {
  std::uint64_t dropped = 0;
  for (auto const& [reason, count] : metrics.dropped) {
    dropped += count;
  }
  std::string table = fmt::format(
      "{} frames in, {} out, {} failed{}, {} dropped{}\n"
      "{:.1f} s, {:.1f} fps, {:.1f} s of processor time, {:.0f} MB at most\n"
      "  {:<12}{:>8}{:>10}{:>10}{:>10}{:>10}\n",
      metrics.frames_in, metrics.frames_out, metrics.failed, counts_text(metrics.failures), dropped,
      counts_text(metrics.dropped), metrics.wall_s, metrics.fps, metrics.cpu_s, metrics.peak_rss_mb,
      "ms", "frames", "p50", "p95", "p99", "max");
  for (auto const& [name, times] : metrics.stages) {
    append_row(table, name, times);
  }
  append_row(table, "latency", metrics.latency);
  return table;
}

}  // namespace credo
