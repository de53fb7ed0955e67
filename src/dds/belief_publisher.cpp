#include "dds/belief_publisher.hpp"

#include <utility>

#include "belief.h"
#include "dds/belief_message.hpp"
#include "dds/entities.hpp"

namespace credo {
namespace {

credo_msg_LifecycleState message_of(LifecycleState state) {
  switch (state) {
    case LifecycleState::kRunning:
      return credo_msg_LIFECYCLE_RUNNING;
    case LifecycleState::kSourceLost:
      return credo_msg_LIFECYCLE_SOURCE_LOST;
    case LifecycleState::kLingering:
      return credo_msg_LIFECYCLE_LINGERING;
    case LifecycleState::kStopping:
      break;
  }
  return credo_msg_LIFECYCLE_STOPPING;
}

}  // namespace

BeliefPublisher::BeliefPublisher(DdsConfig const& config)
    : participant_(config),
      beliefs_(writer_of(participant_, "belief", credo_msg_Belief_desc, last_state_qos())),
      lifecycle_(writer_of(participant_, "lifecycle", credo_msg_Lifecycle_desc, last_state_qos())),
      things_(participant_),
      segmentations_(participant_),
      metrics_(participant_) {}

void BeliefPublisher::publish(BeliefState const& belief, BeliefSummary const& summary) {
  ++revision_;
  dropped_ += things_.write(belief, summary, revision_);
  // The last one, so that whoever sees it finds the things of its revision written.
  BeliefMessage const message(participant_.source(), revision_, summary);
  if (dds_write(beliefs_.handle(), &message.sample()) != DDS_RETCODE_OK) {
    ++dropped_;
  }
}

void BeliefPublisher::publish(Segmentation const& segmentation,
                              CameraIntrinsics const& intrinsics) {
  dropped_ += segmentations_.write(segmentation, intrinsics, revision_) ? 0U : 1U;
}

void BeliefPublisher::publish(RunMetrics const& metrics) {
  dropped_ += metrics_.write(metrics, dropped_) ? 0U : 1U;
}

void BeliefPublisher::tell(LifecycleState state, std::string detail) {
  std::string source = participant_.source();
  credo_msg_Lifecycle sample{};
  sample.source = source.data();
  sample.state = message_of(state);
  sample.detail = detail.data();
  if (dds_write(lifecycle_.handle(), &sample) != DDS_RETCODE_OK) {
    ++dropped_;
  }
}

}  // namespace credo
