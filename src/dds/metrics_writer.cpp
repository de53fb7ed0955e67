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

std::vector<credo_msg_FrameCount> counts_of(std::map<std::string, std::uint64_t> const& counts) {
  std::vector<credo_msg_FrameCount> messages;
  messages.reserve(counts.size());
  for (auto const& [reason, count] : counts) {
    messages.push_back({lent_text(reason), count});
  }
  return messages;
}

}  // namespace

MetricsWriter::MetricsWriter(Participant const& participant)
    : source_(participant.source()),
      writer_(writer_of(participant, "metrics", credo_msg_Metrics_desc, droppable_qos())) {}

bool MetricsWriter::write(RunMetrics const& metrics, std::uint64_t dds_dropped) {
  std::vector<credo_msg_FrameCount> failures = counts_of(metrics.failures);
  std::vector<credo_msg_FrameCount> dropped = counts_of(metrics.dropped);
  std::vector<credo_msg_StageTime> stages;
  stages.reserve(metrics.stages.size());
  for (auto const& [name, duration] : metrics.stages) {
    stages.push_back({lent_text(name), message_of(duration)});
  }
  std::vector<credo_msg_QueueState> queues;
  queues.reserve(metrics.queues.size());
  for (auto const& [name, queue] : metrics.queues) {
    queues.push_back({lent_text(name), queue.capacity, queue.peak, queue.dropped});
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
