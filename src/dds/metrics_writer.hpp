#pragma once

#include <cstdint>
#include <string>

#include "core/run_metrics.hpp"
#include "dds/participant.hpp"

namespace credo {

/// Writes how a run goes to its topic (idl/credo/metrics.idl).
class MetricsWriter {
public:
  explicit MetricsWriter(Participant const& participant);

  /// False where DDS did not take it at once.
  bool write(RunMetrics const& metrics, std::uint64_t dds_dropped);

private:
  std::string source_;
  DdsEntity writer_;
};

}  // namespace credo
