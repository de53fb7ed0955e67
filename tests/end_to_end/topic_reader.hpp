#pragma once

#include <dds/dds.h>

#include <array>
#include <cstddef>

#include "dds/participant.hpp"

namespace credo::test {

enum class Delivery : bool { kReliable, kBestEffort };

/// A reader of <prefix>/<name> with the plain C API.
template <typename State>
class TopicReader {
public:
  TopicReader(Participant const& participant, char const* name, dds_topic_descriptor_t const& type,
              Delivery delivery = Delivery::kReliable) {
    dds_qos_t* qos = dds_create_qos();
    if (delivery == Delivery::kReliable) {
      dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
      dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    }
    dds_entity_t const handle = dds_create_topic(participant.handle(), &type,
                                                 participant.topic(name).c_str(), nullptr, nullptr);
    reader_ = dds_create_reader(participant.handle(), handle, qos, nullptr);
    dds_delete_qos(qos);
  }

  /// Takes what has come, each by `on(sample, info)`.
  template <typename On>
  void take(On const& on) {
    constexpr std::size_t kMost = 64;
    std::array<void*, kMost> samples{};
    std::array<dds_sample_info_t, kMost> infos{};
    dds_return_t const count = dds_take(reader_, samples.data(), infos.data(), kMost, kMost);
    for (dds_return_t i = 0; i < count; ++i) {
      auto const at = static_cast<std::size_t>(i);
      on(*static_cast<State const*>(samples[at]), infos[at]);
    }
    if (count > 0) {
      dds_return_loan(reader_, samples.data(), count);
    }
  }

private:
  dds_entity_t reader_ = 0;
};

}  // namespace credo::test
