#pragma once

#include <cstdint>
#include <string>

#include "core/belief_summary.hpp"
#include "core/dds_config.hpp"
#include "dds/metrics_writer.hpp"
#include "dds/participant.hpp"
#include "dds/segmentation_writer.hpp"
#include "dds/thing_writers.hpp"

namespace credo {

enum class LifecycleState : std::uint8_t { kRunning, kSourceLost, kLingering, kStopping };

/// Puts the belief on DDS after every frame: <prefix>/belief as a whole, then each thing with its
/// points; and <prefix>/lifecycle. The last sample of each is kept for whoever comes late
/// (reliable, transient local). <prefix>/segmentation and <prefix>/metrics are sent once (best
/// effort). A reader that is slow or dead costs it samples, never this process its time. Gone from
/// the readers' view with this object.
class BeliefPublisher {
public:
  /// Throws InputError where DDS refuses (Participant).
  explicit BeliefPublisher(DdsConfig const& config);

  // Called by one thread at a time.

  /// `summary` is of `belief`.
  void publish(BeliefState const& belief, BeliefSummary const& summary);
  /// What the frame showed that the belief published last comes after.
  void publish(Segmentation const& segmentation, CameraIntrinsics const& intrinsics);
  void publish(RunMetrics const& metrics);
  void tell(LifecycleState state, std::string detail);

  /// Samples that DDS did not take at once, because its buffers were full.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

private:
  Participant participant_;
  DdsEntity beliefs_;
  DdsEntity lifecycle_;
  ThingWriters things_;
  SegmentationWriter segmentations_;
  MetricsWriter metrics_;
  std::uint64_t revision_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace credo
