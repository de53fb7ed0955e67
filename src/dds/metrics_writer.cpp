#include "dds/metrics_writer.hpp"

#include <map>
#include <utility>
#include <vector>

#include "dds/entities.hpp"
#include "dds/thing_messages.hpp"
#include "metrics.h"

namespace credo {
namespace {

credo_msg_DurationQuantiles message_of(DurationQuantiles const& duration) {
  return {duration.count, duration.p50_ms, duration.p95_ms, duration.p99_ms, duration.max_ms};
}

/// Reasons with their counts. The message lends the names, which it must not change.
std::vector<credo_msg_FrameCount> counts_of(std::map<std::string, std::uint64_t> const& counts) {
  std::vector<credo_msg_FrameCount> messages;
  for (auto const& [reason, count] : counts) {
    messages.push_back({const_cast<char*>(reason.c_str()), count});  // NOLINT(*-const-cast)
  }
  return messages;
}

}  // namespace

MetricsWriter::MetricsWriter(Participant const& participant)
    : source_(participant.source()),
      writer_(writer_of(participant, "metrics", credo_msg_Metrics_desc, droppable_qos())) {}

bool MetricsWriter::write(RunMetrics metrics, std::uint64_t dds_dropped) {
  std::vector<credo_msg_FrameCount> failures = counts_of(metrics.failures);
  std::vector<credo_msg_FrameCount> dropped = counts_of(metrics.dropped);
  std::vector<credo_msg_StageTime> stages;
  for (auto& [name, duration] : metrics.stages) {
    stages.push_back({name.data(), message_of(duration)});
  }
  std::vector<credo_msg_QueueState> queues;
  for (auto& [name, queue] : metrics.queues) {
    queues.push_back({name.data(), queue.capacity, queue.peak, queue.dropped});
  }
  credo_msg_Metrics sample{};
  sample.source = source_.data();
  sample.frames_in = metrics.frames_in;
  sample.frames_out = metrics.frames_out;
  sample.failed = metrics.failed;
  sample.failures = lent<dds_sequence_credo_msg_FrameCount>(failures);
  sample.dropped = lent<dds_sequence_credo_msg_FrameCount>(dropped);
  sample.wall_s = metrics.wall_s;
  sample.cpu_s = metrics.cpu_s;
  sample.frames_per_s = metrics.fps;
  sample.resident_mb = metrics.rss_mb_end;
  sample.peak_resident_mb = metrics.peak_rss_mb;
  sample.latency = message_of(metrics.latency);
  sample.stages = lent<dds_sequence_credo_msg_StageTime>(stages);
  sample.queues = lent<dds_sequence_credo_msg_QueueState>(queues);
  sample.dds_dropped = dds_dropped;
  return write_now(writer_, sample);
}

}  // namespace credo
