#pragma once

#include <stop_token>

#include "core/belief.hpp"
#include "core/frame_source.hpp"
#include "graph/pipeline_config.hpp"
#include "graph/run_report.hpp"
#include "graph/run_sink.hpp"
#include "graph/stages.hpp"
#include "graph/workers.hpp"

namespace credo {

/// Runs a source through the stages to the sink, many frames at once, until the source ends, `stop`
/// is requested (what was admitted is then finished) or an error ends the run.
///
/// The calling thread reads the source and waits where it must; everything else runs on `workers`.
/// Every frame admitted reaches the sink exactly once, in order, as a result or as a counted loss.
/// With BeliefSeen::kLagged and edges that wait, the results are those of `run_once` at any number
/// of threads.
///
/// Does not throw for what happens during the run: see RunReport::error. A source that throws, or
/// that leaves out or repeats a frame index (std::logic_error), ends the run like any error.
RunReport run_pipeline(FrameSource& source, Stages const& stages, RunSink const& sink,
                       GraphConfig const& config, BeliefPtr const& prior, Workers& workers,
                       std::stop_token const& stop);

}  // namespace credo
