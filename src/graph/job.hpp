#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/belief.hpp"
#include "core/cloud.hpp"
#include "core/frame_source.hpp"
#include "core/segmentation.hpp"
#include "graph/run_sink.hpp"

namespace credo {

/// Frames in a row that were lost in the same way.
struct LostFrames {
  FrameIndex first{0};
  FrameIndex last{0};
  bool dropped = false;
  std::string reason;
  std::string message;
};

/// One frame on its way through the stages. It moves from queue to queue and is never copied.
struct Job {
  using Clock = std::chrono::steady_clock;

  FrameIndex index{0};
  Clock::time_point captured;
  /// Empty once the frame has failed.
  FramePtr frame;
  std::optional<FrameFailure> failure;
  /// Frames dropped just before this one: they keep their place in the order by travelling with
  /// it, and take no room of their own.
  std::vector<LostFrames> lost_before;

  NormalMap normals;
  Segmentation segmentation;
  BeliefPtr belief;
  Delivery delivery;

  [[nodiscard]] bool alive() const { return frame != nullptr; }
  /// Keeps the number and the reason, lets everything else go.
  void fail(std::string reason, std::string message);
  /// The last frame before this one that is not travelling with it.
  [[nodiscard]] FrameIndex last_settled_before() const;
};
using JobPtr = std::unique_ptr<Job>;

/// Lets `dropped`, and what travelled with it, travel with `next`; `edge` is where it gave way.
void inherit_lost(JobPtr dropped, Job& next, std::string const& edge);

}  // namespace credo
