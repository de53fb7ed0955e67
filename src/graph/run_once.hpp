#pragma once

#include <stop_token>

#include "core/belief.hpp"
#include "core/frame_source.hpp"
#include "graph/pipeline_config.hpp"
#include "graph/run_report.hpp"
#include "graph/run_sink.hpp"
#include "graph/stages.hpp"

namespace credo {

/// What a run computes, one frame after the other on the calling thread: segment, fuse, hand out.
/// It is the specification of `run_pipeline`, which must give the sink the same results. The report
/// carries counts and the error; stages and queues stay empty, and a frame that fails here fails
/// under "segmentation" or "fusion". BeliefSeen::kNewest is a lag of 1 here.
RunReport run_once(FrameSource& source, Stages const& stages, RunSink const& sink,
                   GraphConfig const& config, BeliefPtr const& prior, std::stop_token const& stop);

}  // namespace credo
