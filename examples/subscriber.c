/* Prints what Credo believes of known objects, in C. Needs Cyclone DDS and idl/credo/belief.idl.
 * Listens where CYCLONEDDS_URI says; Credo itself stays on the loopback unless told otherwise:
 *   export CYCLONEDDS_URI='<General><Interfaces><NetworkInterface name="lo"
 * multicast="true"/></Interfaces></General>'
 */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

#include "belief.h"

static dds_entity_t checked(dds_entity_t entity, char const* what) {
  if (entity < 0) {
    fprintf(stderr, "%s: %s\n", what, dds_strretcode(-entity));
    exit(1);
  }
  return entity;
}

int main(int argc, char** argv) {
  char const* topic_name = argc > 1 ? argv[1] : "credo/belief";
  dds_entity_t const participant =
      checked(dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL), "participant");
  dds_entity_t const topic = checked(
      dds_create_topic(participant, &credo_msg_Belief_desc, topic_name, NULL, NULL), "topic");
  /* As the writer has it: then the last belief comes at once, however late we are. */
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_entity_t const reader = checked(dds_create_reader(participant, topic, qos, NULL), "reader");
  dds_delete_qos(qos);
  dds_entity_t const waitset = checked(dds_create_waitset(participant), "waitset");
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waitset, reader, 0);

  /* Ten seconds without a belief end it. */
  while (dds_waitset_wait(waitset, NULL, 0, DDS_SECS(10)) > 0) {
    void* sample = NULL; /* lent by DDS */
    dds_sample_info_t info;
    while (dds_take(reader, &sample, &info, 1, 1) > 0) {
      if (info.valid_data) {
        credo_msg_Belief const* belief = sample;
        printf("%s frame %lld: %u walls, %u things that nobody knows\n", belief->source,
               (long long)belief->frame, belief->walls._length, belief->stuff._length);
        for (uint32_t i = 0; i < belief->objects._length; ++i) {
          credo_msg_KnownObject const* object = &belief->objects._buffer[i];
          printf("  %s at (%.2f, %.2f, %.2f) m with probability %.3f\n", object->object_id,
                 object->position_world_m[0], object->position_world_m[1],
                 object->position_world_m[2], object->probability);
        }
        fflush(stdout);
      }
      dds_return_loan(reader, &sample, 1);
      sample = NULL;
    }
  }
  dds_delete(participant);
  return 0;
}
