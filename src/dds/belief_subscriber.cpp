#include "dds/belief_subscriber.hpp"

#include <array>
#include <utility>

#include "belief.h"
#include "dds/belief_message.hpp"
#include "dds/entities.hpp"

namespace credo {
namespace {

constexpr std::size_t kMaxSources = 64;

ReceivedBelief received(credo_msg_Belief const& sample, dds_sample_info_t const& info) {
  ReceivedBelief result;
  // Of an instance without data only the key is there.
  result.source = sample.source;
  result.gone = !info.valid_data;
  if (info.valid_data) {
    result.revision = sample.revision;
    result.belief = belief_in(sample);
  }
  return result;
}

}  // namespace

BeliefSubscriber::BeliefSubscriber(DdsConfig const& config)
    : participant_(config),
      reader_(reader_of(participant_, "belief", credo_msg_Belief_desc, last_state_qos())),
      waitset_(checked(dds_create_waitset(participant_.handle()), "waitset")) {
  dds_set_status_mask(reader_.handle(), DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waitset_.handle(), reader_.handle(), 0);
}

std::vector<ReceivedBelief> BeliefSubscriber::take(std::chrono::milliseconds timeout) {
  dds_waitset_wait(waitset_.handle(), nullptr, 0,
                   std::chrono::duration_cast<std::chrono::nanoseconds>(timeout).count());
  std::array<void*, kMaxSources> samples{};
  std::array<dds_sample_info_t, kMaxSources> infos{};
  dds_return_t const count =
      dds_take(reader_.handle(), samples.data(), infos.data(), kMaxSources, kMaxSources);
  std::vector<ReceivedBelief> beliefs;
  for (dds_return_t i = 0; i < count; ++i) {
    auto const at = static_cast<std::size_t>(i);
    beliefs.push_back(received(*static_cast<credo_msg_Belief const*>(samples[at]), infos[at]));
  }
  if (count > 0) {
    dds_return_loan(reader_.handle(), samples.data(), count);
  }
  return beliefs;
}

}  // namespace credo
