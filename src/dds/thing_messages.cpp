#include "dds/thing_messages.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

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

credo_msg_PixelLabel message_of(std::optional<LabelCode> const& label) {
  return {label.has_value(), label.value_or(0)};
}

std::optional<LabelCode> label_in(credo_msg_PixelLabel const& label) {
  return label.given ? std::optional<LabelCode>(label.code) : std::nullopt;
}

credo_msg_Account message_of(Account const& why) {
  auto const points = [&](PointState state) {
    return static_cast<std::uint32_t>(why.points[state]);
  };
  return {points(PointState::kAgrees),
          points(PointState::kOccluded),
          points(PointState::kSeenThrough),
          points(PointState::kUnmeasured),
          points(PointState::kOutOfView),
          why.visible_share,
          why.news,
          why.moved,
          why.bounded};
}

Account account_in(credo_msg_Account const& message) {
  Account why;
  why.points[PointState::kAgrees] = static_cast<int>(message.agrees);
  why.points[PointState::kOccluded] = static_cast<int>(message.occluded);
  why.points[PointState::kSeenThrough] = static_cast<int>(message.seen_through);
  why.points[PointState::kUnmeasured] = static_cast<int>(message.no_depth);
  why.points[PointState::kOutOfView] = static_cast<int>(message.out_of_view);
  why.visible_share = message.visible_share;
  why.news = message.news;
  why.moved = message.moved;
  why.bounded = message.bounded;
  return why;
}

/// How sure it is that a thing is there, and why.
template <typename Summary, typename Message>
void put_existence(Summary const& thing, Message& message) {
  message.probability = thing.probability;
  message.log_odds = thing.log_odds;
  message.evidence = message_of(thing.evidence);
  message.why = message_of(thing.why.value_or(Account()));
}

template <typename Message, typename Summary>
void get_existence(Message const& message, Summary& thing) {
  thing.probability = message.probability;
  thing.log_odds = message.log_odds;
  thing.evidence = evidence_in(message.evidence);
  thing.why = account_in(message.why);
}

template <typename Values, std::size_t kSize>
void put(Values const& values, typename Values::Scalar (&target)[kSize]) {
  std::copy_n(values.data(), kSize, target);
}

template <std::size_t kSize, typename Scalar>
Eigen::Matrix<Scalar, static_cast<int>(kSize), 1> get(Scalar const (&source)[kSize]) {
  return Eigen::Map<Eigen::Matrix<Scalar, static_cast<int>(kSize), 1> const>(source);
}

/// Matrices go row by row.
using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

}  // namespace

credo_msg_FloorPlane message_of(FloorSummary const& floor) {
  credo_msg_FloorPlane message{};
  put(floor.normal, message.normal_world);
  message.height_m = floor.height_m;
  message.point_count = floor.point_count;
  put_existence(floor, message);
  return message;
}

credo_msg_WallSegment message_of(WallSummary const& wall) {
  credo_msg_WallSegment message{};
  message.wall_id = wall.id;
  put(wall.segment_start_m, message.segment_start_world_m);
  put(wall.segment_end_m, message.segment_end_world_m);
  put(wall.normal, message.normal_world);
  message.point_count = wall.point_count;
  message.label = message_of(wall.label);
  put_existence(wall, message);
  return message;
}

credo_msg_KnownObject message_of(ObjectSummary& object) {
  credo_msg_KnownObject message{};
  message.object_id = object.id.data();
  message.type = object.type.data();
  put(object.position_m, message.position_world_m);
  put(object.orientation.coeffs(), message.orientation_world_xyzw);
  Eigen::Map<RowMajor6d>(message.covariance) = object.covariance;
  message.label = message_of(object.label);
  put_existence(object, message);
  return message;
}

credo_msg_StuffItem message_of(StuffSummary const& stuff) {
  credo_msg_StuffItem message{};
  message.stuff_id = stuff.id;
  message.history_count = stuff.history_count;
  message.pixel_count = stuff.pixel_count;
  put(stuff.centroid_m, message.centroid_world_m);
  put(stuff.min_m, message.min_world_m);
  put(stuff.max_m, message.max_world_m);
  message.label = message_of(stuff.label);
  put_existence(stuff, message);
  message.joined_ids =
      lent_values<decltype(message.joined_ids)>(stuff.joined_ids.data(), stuff.joined_ids.size());
  return message;
}

FloorSummary floor_in(credo_msg_FloorPlane const& message) {
  FloorSummary floor;
  floor.normal = get(message.normal_world);
  floor.height_m = message.height_m;
  floor.point_count = message.point_count;
  get_existence(message, floor);
  return floor;
}

WallSummary wall_in(credo_msg_WallSegment const& message) {
  WallSummary wall;
  wall.id = message.wall_id;
  wall.segment_start_m = get(message.segment_start_world_m);
  wall.segment_end_m = get(message.segment_end_world_m);
  wall.normal = get(message.normal_world);
  wall.point_count = message.point_count;
  wall.label = label_in(message.label);
  get_existence(message, wall);
  return wall;
}

ObjectSummary object_in(credo_msg_KnownObject const& message) {
  ObjectSummary object;
  object.id = message.object_id;
  object.type = message.type;
  object.position_m = get(message.position_world_m);
  object.orientation.coeffs() = get(message.orientation_world_xyzw);
  object.covariance = Eigen::Map<RowMajor6d const>(message.covariance);
  object.label = label_in(message.label);
  get_existence(message, object);
  return object;
}

StuffSummary stuff_in(credo_msg_StuffItem const& message) {
  StuffSummary stuff;
  stuff.id = message.stuff_id;
  stuff.history_count = message.history_count;
  stuff.pixel_count = message.pixel_count;
  stuff.centroid_m = get(message.centroid_world_m);
  stuff.min_m = get(message.min_world_m);
  stuff.max_m = get(message.max_world_m);
  stuff.label = label_in(message.label);
  get_existence(message, stuff);
  std::copy_n(message.joined_ids._buffer, message.joined_ids._length,
              std::back_inserter(stuff.joined_ids));
  return stuff;
}

}  // namespace credo
