#pragma once

#include <exception>

#include "core/run_metrics.hpp"

namespace credo {

/// What became of a run.
///
/// `metrics.failures` counts by the source's own reason, or by the name of the stage that threw;
/// "sink" is a result that could not be handed out. `metrics.dropped` counts by "<edge>_full", or
/// "stopped" for what was still under way when an error ended the run. Times are of frames that
/// were good when they came; the latency runs from the source's hands to the end of the delivery,
/// waiting included. Processor time and memory are the whole process'.
struct RunReport {
  RunMetrics metrics;
  /// What ended the run before its source did, if anything; a stop on request is none. InputError
  /// for too many failures in a row and for a source without one good frame.
  std::exception_ptr error;
};

}  // namespace credo
