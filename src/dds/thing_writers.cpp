#include "dds/thing_writers.hpp"

#include <utility>

#include "dds/entities.hpp"
#include "dds/thing_messages.hpp"
#include "things.h"

namespace credo {
namespace {

dds_sequence_float lent_points(PointList const& points) {
  static_assert(sizeof(PointList::value_type) == 3 * sizeof(float));
  return points.empty() ? dds_sequence_float{}
                        : lent_values<dds_sequence_float>(points.front().data(), 3 * points.size());
}

/// Counts the writes that fail.
class Writes {
public:
  template <typename State>
  void write(DdsEntity const& writer, State const& state) {
    failed_ += dds_write(writer.handle(), &state) == DDS_RETCODE_OK ? 0U : 1U;
  }
  /// Only the key counts.
  template <typename State>
  void dispose(DdsEntity const& writer, State const& state) {
    failed_ += dds_dispose(writer.handle(), &state) == DDS_RETCODE_OK ? 0U : 1U;
  }
  [[nodiscard]] std::uint64_t failed() const { return failed_; }

private:
  std::uint64_t failed_ = 0;
};

/// Of `before`, those that are not in `now`, by `dispose`; then `before` is `now`.
template <typename Id, typename Dispose>
void dispose_gone(std::set<Id>& before, std::set<Id> now, Dispose const& dispose) {
  for (Id const& id : before) {
    if (!now.contains(id)) {
      dispose(id);
    }
  }
  before = std::move(now);
}

}  // namespace

ThingWriters::ThingWriters(Participant const& participant)
    : source_(participant.source()),
      floor_(writer_of(participant, "floor", credo_msg_FloorState_desc, last_state_qos())),
      walls_(writer_of(participant, "walls", credo_msg_WallState_desc, last_state_qos())),
      objects_(writer_of(participant, "objects", credo_msg_ObjectState_desc, last_state_qos())),
      stuff_(writer_of(participant, "stuff", credo_msg_StuffState_desc, last_state_qos())) {}

std::uint64_t ThingWriters::write(BeliefState const& belief, BeliefSummary summary,
                                  std::uint64_t revision) {
  Writes writes;
  if (summary.floor) {
    credo_msg_FloorState state{source_.data(), revision, message_of(*summary.floor), {}};
    state.points_world_m = lent_points(*belief.floor->points);
    writes.write(floor_, state);
  } else if (has_floor_) {
    writes.dispose(floor_, credo_msg_FloorState{source_.data(), revision, {}, {}});
  }
  has_floor_ = summary.floor.has_value();
  std::set<std::uint32_t> walls;
  for (std::size_t i = 0; i < summary.walls.size(); ++i) {
    WallSummary const& wall = summary.walls[i];
    credo_msg_WallState state{source_.data(), wall.id, revision, message_of(wall), {}};
    state.points_world_m = lent_points(*belief.walls[i].points);
    writes.write(walls_, state);
    walls.insert(wall.id);
  }
  std::set<std::string> objects;
  for (ObjectSummary& object : summary.objects) {
    credo_msg_ObjectState const state{source_.data(), object.id.data(), revision,
                                      message_of(object)};
    writes.write(objects_, state);
    objects.insert(object.id);
  }
  std::set<std::uint32_t> stuff;
  for (std::size_t i = 0; i < summary.stuff.size(); ++i) {
    StuffSummary const& thing = summary.stuff[i];
    credo_msg_StuffState state{source_.data(), thing.id, revision, message_of(thing), {}};
    state.points_world_m = lent_points(belief.stuff[i].latest().points_world);
    writes.write(stuff_, state);
    stuff.insert(thing.id);
  }
  dispose_gone(wall_ids_, std::move(walls), [&](std::uint32_t id) {
    writes.dispose(walls_, credo_msg_WallState{source_.data(), id, revision, {}, {}});
  });
  dispose_gone(object_ids_, std::move(objects), [&](std::string id) {
    writes.dispose(objects_, credo_msg_ObjectState{source_.data(), id.data(), revision, {}});
  });
  dispose_gone(stuff_ids_, std::move(stuff), [&](std::uint32_t id) {
    writes.dispose(stuff_, credo_msg_StuffState{source_.data(), id, revision, {}, {}});
  });
  for (DdsEntity const* writer : {&floor_, &walls_, &objects_, &stuff_}) {
    flush(*writer);
  }
  return writes.failed();
}

}  // namespace credo
