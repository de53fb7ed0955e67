#pragma once

#include <dds/dds.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "dds/participant.hpp"

namespace credo {

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;

/// Reliable, the last sample of each instance kept for whoever comes late. A write never waits.
inline Qos last_state_qos() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  return qos;
}

/// Sent once, and lost to whoever is late or slow.
inline Qos droppable_qos() {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  return qos;
}

/// For a publisher or subscriber.
inline Qos partition_qos(Participant const& participant) {
  Qos qos(dds_create_qos());
  if (!participant.partition().empty()) {
    dds_qset_partition1(qos.get(), participant.partition().c_str());
  }
  return qos;
}

/// Takes over what a function of the C API returned. Throws std::runtime_error where that is an
/// error.
inline DdsEntity checked(dds_entity_t handle, std::string const& what) {
  if (handle <= 0) {
    throw std::runtime_error("DDS " + what + ": " + dds_strretcode(-handle));
  }
  return DdsEntity(handle);
}

/// A writer of <prefix>/<name>. Its topic and publisher are children of the participant and go with
/// it.
inline DdsEntity writer_of(Participant const& participant, char const* name,
                           dds_topic_descriptor_t const& type, Qos const& qos) {
  std::string const topic_name = participant.topic(name);
  dds_entity_t const topic =
      dds_create_topic(participant.handle(), &type, topic_name.c_str(), nullptr, nullptr);
  dds_entity_t const publisher =
      dds_create_publisher(participant.handle(), partition_qos(participant).get(), nullptr);
  return checked(dds_create_writer(publisher, topic, qos.get(), nullptr),
                 "writer of " + topic_name);
}

/// A reader of <prefix>/<name>. Its topic and subscriber are children of the participant and go
/// with it.
inline DdsEntity reader_of(Participant const& participant, char const* name,
                           dds_topic_descriptor_t const& type, Qos const& qos) {
  std::string const topic_name = participant.topic(name);
  dds_entity_t const topic =
      dds_create_topic(participant.handle(), &type, topic_name.c_str(), nullptr, nullptr);
  dds_entity_t const subscriber =
      dds_create_subscriber(participant.handle(), partition_qos(participant).get(), nullptr);
  return checked(dds_create_reader(subscriber, topic, qos.get(), nullptr),
                 "reader of " + topic_name);
}

/// Sends what was written: with write batching, small samples wait to share a packet. Does nothing
/// without.
inline void flush(DdsEntity const& writer) {
  dds_write_flush(writer.handle());
}

/// Writes and sends. False where DDS did not take it at once.
template <typename Sample>
bool write_now(DdsEntity const& writer, Sample const& sample) {
  bool const taken = dds_write(writer.handle(), &sample) == DDS_RETCODE_OK;
  flush(writer);
  return taken;
}

/// Whether anyone writes what the reader reads.
inline bool has_writers(DdsEntity const& reader) {
  dds_subscription_matched_status_t status{};
  return dds_get_subscription_matched_status(reader.handle(), &status) == DDS_RETCODE_OK &&
         status.current_count > 0;
}

/// Whether a sample would reach anyone: large ones are not made for nobody.
inline bool has_readers(DdsEntity const& writer) {
  dds_publication_matched_status_t status{};
  return dds_get_publication_matched_status(writer.handle(), &status) == DDS_RETCODE_OK &&
         status.current_count > 0;
}

}  // namespace credo
