#include "dds/belief_publisher.hpp"

#include <utility>

#include "belief.h"
#include "dds/belief_message.hpp"
#include "dds/qos.hpp"

namespace credo {
namespace {

DdsEntity writer_of(Participant const& participant, char const* name,
                    dds_topic_descriptor_t const& type) {
  // Topics, publishers and writers are children of the participant and go with it.
  Qos const qos = last_state_qos();
  dds_entity_t const topic = dds_create_topic(participant.handle(), &type,
                                              participant.topic(name).c_str(), nullptr, nullptr);
  dds_entity_t const publisher =
      dds_create_publisher(participant.handle(), partition_qos(participant).get(), nullptr);
  return checked(dds_create_writer(publisher, topic, qos.get(), nullptr),
                 "writer of " + participant.topic(name));
}

credo_msg_LifecycleState message_of(LifecycleState state) {
  switch (state) {
    case LifecycleState::kRunning:
      return credo_msg_LIFECYCLE_RUNNING;
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
      beliefs_(writer_of(participant_, "belief", credo_msg_Belief_desc)),
      lifecycle_(writer_of(participant_, "lifecycle", credo_msg_Lifecycle_desc)) {}

void BeliefPublisher::publish(BeliefSummary belief) {
  BeliefMessage const message(participant_.source(), ++revision_, std::move(belief));
  if (dds_write(beliefs_.handle(), &message.sample()) != DDS_RETCODE_OK) {
    ++dropped_;
  }
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
