#include "dds/belief_message.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "belief.h"
#include "dds/thing_messages.hpp"

namespace credo {
namespace {

/// Matrices go row by row.
using RowMajor4d = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

template <typename Message, typename Summary>
std::vector<Message> messages_of(std::vector<Summary>& summaries) {
  std::vector<Message> messages;
  messages.reserve(summaries.size());
  for (Summary& summary : summaries) {
    messages.push_back(message_of(summary));
  }
  return messages;
}

template <typename Sequence, typename ToSummary>
auto summaries_in(Sequence const& sequence, ToSummary const& to_summary) {
  std::vector<decltype(to_summary(*sequence._buffer))> summaries;
  summaries.reserve(sequence._length);
  std::transform(sequence._buffer, sequence._buffer + sequence._length,
                 std::back_inserter(summaries), to_summary);
  return summaries;
}

}  // namespace

struct BeliefMessage::Parts {
  std::string source;
  BeliefSummary belief;
  std::vector<credo_msg_FloorPlane> floor;
  std::vector<credo_msg_WallSegment> walls;
  std::vector<credo_msg_KnownObject> objects;
  std::vector<credo_msg_StuffItem> stuff;
  credo_msg_Belief sample{};
};

BeliefMessage::BeliefMessage(std::string source, std::uint64_t revision, BeliefSummary belief)
    : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  parts.source = std::move(source);
  parts.belief = std::move(belief);
  if (parts.belief.floor) {
    parts.floor.push_back(message_of(*parts.belief.floor));
  }
  parts.walls = messages_of<credo_msg_WallSegment>(parts.belief.walls);
  parts.objects = messages_of<credo_msg_KnownObject>(parts.belief.objects);
  parts.stuff = messages_of<credo_msg_StuffItem>(parts.belief.stuff);
  credo_msg_Belief& sample = parts.sample;
  sample.source = parts.source.data();
  sample.revision = revision;
  sample.frame = number(parts.belief.frame);
  sample.stamp_ns = parts.belief.stamp_ns;
  sample.segmented_with = number(parts.belief.segmented_with);
  Eigen::Map<RowMajor4d>(sample.T_world_camera) = parts.belief.T_world_camera;
  sample.floor = lent<decltype(sample.floor)>(parts.floor);
  sample.walls = lent<decltype(sample.walls)>(parts.walls);
  sample.objects = lent<decltype(sample.objects)>(parts.objects);
  sample.stuff = lent<decltype(sample.stuff)>(parts.stuff);
}

BeliefMessage::~BeliefMessage() = default;

credo_msg_Belief const& BeliefMessage::sample() const {
  return parts_->sample;
}

BeliefSummary belief_in(credo_msg_Belief const& sample) {
  BeliefSummary belief;
  belief.frame = FrameIndex{sample.frame};
  belief.stamp_ns = sample.stamp_ns;
  belief.segmented_with = FrameIndex{sample.segmented_with};
  belief.T_world_camera = Eigen::Map<RowMajor4d const>(sample.T_world_camera);
  if (sample.floor._length > 0) {
    belief.floor = floor_in(sample.floor._buffer[0]);
  }
  belief.walls = summaries_in(sample.walls, wall_in);
  belief.objects = summaries_in(sample.objects, object_in);
  belief.stuff = summaries_in(sample.stuff, stuff_in);
  return belief;
}

}  // namespace credo
