// Keeps the world's unknown things with their points, in C++: each is an instance of the topic, and
// leaves with it. Needs Cyclone DDS and idl/credo/*.idl. Listens where CYCLONEDDS_URI says; Credo
// itself stays on the loopback unless told otherwise (docs/topics.md).
#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "things.h"

namespace {

dds_entity_t checked(dds_entity_t entity, char const* what) {
  if (entity < 0) {
    throw std::runtime_error(std::string(what) + ": " + dds_strretcode(-entity));
  }
  return entity;
}

struct Thing {
  double probability = 0.0;
  std::vector<std::array<float, 3>> points_world_m;
};

/// By source and id.
using World = std::map<std::pair<std::string, std::uint32_t>, Thing>;

Thing thing_of(credo_msg_StuffState const& state) {
  Thing thing{state.stuff.probability, {}};
  float const* p = state.points_world_m._buffer;
  for (std::uint32_t i = 0; i + 2 < state.points_world_m._length; i += 3) {
    thing.points_world_m.push_back({p[i], p[i + 1], p[i + 2]});
  }
  return thing;
}

/// Takes what has come into the world.
void take(dds_entity_t reader, World& world) {
  std::array<void*, 32> samples{};
  std::array<dds_sample_info_t, 32> infos{};
  dds_return_t count = 0;
  while ((count = dds_take(reader, samples.data(), infos.data(), samples.size(), 32)) > 0) {
    for (dds_return_t i = 0; i < count; ++i) {
      auto const& state = *static_cast<credo_msg_StuffState const*>(samples[i]);
      std::pair<std::string, std::uint32_t> const key{state.source, state.stuff_id};
      if (infos[i].instance_state == DDS_IST_ALIVE) {
        world[key] = thing_of(state);
      } else {
        world.erase(key);
      }
    }
    dds_return_loan(reader, samples.data(), count);
    samples.fill(nullptr);
  }
}

int listen(char const* topic_name) {
  dds_entity_t const participant =
      checked(dds_create_participant(DDS_DOMAIN_DEFAULT, nullptr, nullptr), "participant");
  dds_entity_t const topic = checked(
      dds_create_topic(participant, &credo_msg_StuffState_desc, topic_name, nullptr, nullptr),
      "topic");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_entity_t const reader =
      checked(dds_create_reader(participant, topic, qos, nullptr), "reader");
  dds_delete_qos(qos);
  dds_entity_t const waitset = checked(dds_create_waitset(participant), "waitset");
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waitset, reader, 0);

  World world;
  // Ten seconds of silence end it.
  while (dds_waitset_wait(waitset, nullptr, 0, DDS_SECS(10)) > 0) {
    take(reader, world);
    std::printf("%zu things\n", world.size());
    for (auto const& [key, thing] : world) {
      std::printf("  %s #%u: %.3f, %zu points\n", key.first.c_str(), key.second, thing.probability,
                  thing.points_world_m.size());
    }
    std::fflush(stdout);
  }
  dds_delete(participant);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return listen(argc > 1 ? argv[1] : "credo/stuff");
  } catch (std::exception const& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
