#pragma once

#include <chrono>
#include <functional>

#include "core/belief.hpp"
#include "core/frame.hpp"
#include "core/frame_source.hpp"
#include "core/run_metrics.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// A good frame, and what came of it.
struct FrameResult {
  /// When the source handed the frame out.
  std::chrono::steady_clock::time_point captured;
  FramePtr frame;
  SegmentationPtr segmentation;
  /// After this frame.
  BeliefPtr belief;
};

/// Hands one result out: writes it, shows it, sends it.
using Delivery = std::function<void()>;

/// Where a run's results go. Every frame that was admitted ends in exactly one call: its delivery
/// or `lost`, in the order of the frames, one at a time; `metrics` comes between them. What these
/// or `encode` throw ends the run.
struct RunSink {
  /// The costly part, such as compressing images, and without effect outside: called for several
  /// frames at once, in any order. What it returns does the rest.
  std::function<Delivery(FrameResult const&)> encode;
  /// A frame that failed or was dropped; the reason is the key it is counted under.
  std::function<void(FrameFailure const&)> lost;
  /// How the run goes so far: after a frame, once a second at most; must not throw.
  /// Empty where nobody asks.
  std::function<void(RunMetrics const&)> metrics = {};
};

}  // namespace credo
