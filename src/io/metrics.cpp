#include "io/metrics.hpp"

#include <nlohmann/json.hpp>

namespace credo {

std::string metrics_json(RunMetrics const& metrics) {
  using Json = nlohmann::ordered_json;
  DurationQuantiles const& latency = metrics.latency;
  Json json = {{"frames_in", metrics.frames_in},
               {"frames_out", metrics.frames_out},
               {"failed", metrics.failed},
               {"failures", Json(metrics.failures)},
               {"dropped", Json(metrics.dropped)},
               {"wall_s", metrics.wall_s},
               {"cpu_s", metrics.cpu_s},
               {"fps", metrics.fps},
               {"peak_rss_mb", metrics.peak_rss_mb},
               {"rss_mb_at_100", metrics.rss_mb_at_100},
               {"rss_mb_end", metrics.rss_mb_end},
               {"latency_ms",
                {{"p50", latency.p50_ms},
                 {"p95", latency.p95_ms},
                 {"p99", latency.p99_ms},
                 {"max", latency.max_ms}}},
               {"stages", Json::object()},
               {"queues", Json::object()}};
  for (auto const& [name, stage] : metrics.stages) {
    json["stages"][name] = {{"count", stage.count},
                            {"p50_ms", stage.p50_ms},
                            {"p95_ms", stage.p95_ms},
                            {"p99_ms", stage.p99_ms},
                            {"max_ms", stage.max_ms}};
  }
  for (auto const& [edge, queue] : metrics.queues) {
    json["queues"][edge] = {
        {"capacity", queue.capacity}, {"peak", queue.peak}, {"dropped", queue.dropped}};
  }
  return json.dump(2) + "\n";
}

}  // namespace credo
