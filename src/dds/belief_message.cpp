#include "dds/belief_message.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "belief.h"

namespace credo {
namespace {

constexpr credo_msg_Evidence kEvidences[] = {
    credo_msg_EVIDENCE_SEEN, credo_msg_EVIDENCE_SEEN_THROUGH, credo_msg_EVIDENCE_OCCLUDED,
    credo_msg_EVIDENCE_OUT_OF_VIEW, credo_msg_EVIDENCE_NOT_SEEN};

credo_msg_Evidence message_of(Evidence evidence) {
  return kEvidences[static_cast<std::size_t>(evidence)];
}

Evidence evidence_in(credo_msg_Evidence evidence) {
  auto const* const found = std::ranges::find(kEvidences, evidence);
  if (found == std::end(kEvidences)) {
    throw std::runtime_error("a belief on DDS has evidence " + std::to_string(evidence) +
                             ", which is none");
  }
  return static_cast<Evidence>(found - std::begin(kEvidences));
}

credo_msg_Label message_of(std::optional<LabelCode> const& label) {
  return {label.has_value(), label.value_or(0)};
}

std::optional<LabelCode> label_in(credo_msg_Label const& label) {
  return label.given ? std::optional<LabelCode>(label.code) : std::nullopt;
}

template <typename Values, std::size_t kSize>
void put(Values const& values, typename Values::Scalar (&target)[kSize]) {
  std::copy_n(values.data(), kSize, target);
}

template <std::size_t kSize, typename Scalar>
Eigen::Matrix<Scalar, static_cast<int>(kSize), 1> get(Scalar const (&source)[kSize]) {
  return Eigen::Map<Eigen::Matrix<Scalar, static_cast<int>(kSize), 1> const>(source);
}

/// Square matrices go row by row.
template <int kSide>
using RowMajor = Eigen::Matrix<double, kSide, kSide, Eigen::RowMajor>;

credo_msg_Floor message_of(FloorSummary const& floor) {
  credo_msg_Floor message{};
  put(floor.normal, message.normal_world);
  message.height_m = floor.height_m;
  message.point_count = floor.point_count;
  return message;
}

credo_msg_Wall message_of(WallSummary const& wall) {
  credo_msg_Wall message{};
  message.wall_id = wall.id;
  put(wall.segment_start_m, message.segment_start_world_m);
  put(wall.segment_end_m, message.segment_end_world_m);
  put(wall.normal, message.normal_world);
  message.point_count = wall.point_count;
  message.label = message_of(wall.label);
  return message;
}

/// Lends the names: DDS takes them by a pointer to char, though it does not write to them.
credo_msg_KnownObject message_of(ObjectSummary& object) {
  credo_msg_KnownObject message{};
  message.object_id = object.id.data();
  message.type = object.type.data();
  message.probability = object.probability;
  put(object.position_m, message.position_world_m);
  put(object.orientation.coeffs(), message.orientation_world_xyzw);
  Eigen::Map<RowMajor<6>>(message.covariance) = object.covariance;
  message.evidence = message_of(object.evidence);
  message.label = message_of(object.label);
  return message;
}

credo_msg_Stuff message_of(StuffSummary const& stuff) {
  credo_msg_Stuff message{};
  message.stuff_id = stuff.id;
  message.probability = stuff.probability;
  message.history_count = stuff.history_count;
  message.pixel_count = stuff.pixel_count;
  put(stuff.centroid_m, message.centroid_world_m);
  put(stuff.min_m, message.min_world_m);
  put(stuff.max_m, message.max_world_m);
  message.evidence = message_of(stuff.evidence);
  message.label = message_of(stuff.label);
  return message;
}

FloorSummary floor_in(credo_msg_Floor const& message) {
  return {get(message.normal_world), message.height_m, message.point_count};
}

WallSummary wall_in(credo_msg_Wall const& message) {
  return {message.wall_id,
          get(message.segment_start_world_m),
          get(message.segment_end_world_m),
          get(message.normal_world),
          message.point_count,
          label_in(message.label)};
}

ObjectSummary object_in(credo_msg_KnownObject const& message) {
  ObjectSummary object;
  object.id = message.object_id;
  object.type = message.type;
  object.probability = message.probability;
  object.position_m = get(message.position_world_m);
  object.orientation.coeffs() = get(message.orientation_world_xyzw);
  object.covariance = Eigen::Map<RowMajor<6> const>(message.covariance);
  object.evidence = evidence_in(message.evidence);
  object.label = label_in(message.label);
  return object;
}

StuffSummary stuff_in(credo_msg_Stuff const& message) {
  return {message.stuff_id,         message.probability,           message.history_count,
          message.pixel_count,      get(message.centroid_world_m), get(message.min_world_m),
          get(message.max_world_m), evidence_in(message.evidence), label_in(message.label)};
}

/// A sequence that lends the vector's elements.
template <typename Sequence, typename Element>
Sequence lent(std::vector<Element>& elements) {
  Sequence sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(elements.size());
  sequence._buffer = elements.data();
  sequence._release = false;
  return sequence;
}

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
  std::vector<credo_msg_Floor> floor;
  std::vector<credo_msg_Wall> walls;
  std::vector<credo_msg_KnownObject> objects;
  std::vector<credo_msg_Stuff> stuff;
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
  parts.walls = messages_of<credo_msg_Wall>(parts.belief.walls);
  parts.objects = messages_of<credo_msg_KnownObject>(parts.belief.objects);
  parts.stuff = messages_of<credo_msg_Stuff>(parts.belief.stuff);
  credo_msg_Belief& sample = parts.sample;
  sample.source = parts.source.data();
  sample.revision = revision;
  sample.frame = number(parts.belief.frame);
  sample.stamp_ns = parts.belief.stamp_ns;
  sample.segmented_with = number(parts.belief.segmented_with);
  Eigen::Map<RowMajor<4>>(sample.T_world_camera) = parts.belief.T_world_camera;
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
  belief.T_world_camera = Eigen::Map<RowMajor<4> const>(sample.T_world_camera);
  if (sample.floor._length > 0) {
    belief.floor = floor_in(sample.floor._buffer[0]);
  }
  belief.walls = summaries_in(sample.walls, wall_in);
  belief.objects = summaries_in(sample.objects, object_in);
  belief.stuff = summaries_in(sample.stuff, stuff_in);
  return belief;
}

}  // namespace credo
