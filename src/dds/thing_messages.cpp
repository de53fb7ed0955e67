#include "dds/thing_messages.hpp"

#include <algorithm>
#include <cstddef>
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
  return message;
}

credo_msg_KnownObject message_of(ObjectSummary& object) {
  credo_msg_KnownObject message{};
  message.object_id = object.id.data();
  message.type = object.type.data();
  message.probability = object.probability;
  put(object.position_m, message.position_world_m);
  put(object.orientation.coeffs(), message.orientation_world_xyzw);
  Eigen::Map<RowMajor6d>(message.covariance) = object.covariance;
  message.evidence = message_of(object.evidence);
  message.label = message_of(object.label);
  return message;
}

credo_msg_StuffItem message_of(StuffSummary const& stuff) {
  credo_msg_StuffItem message{};
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

FloorSummary floor_in(credo_msg_FloorPlane const& message) {
  return {get(message.normal_world), message.height_m, message.point_count};
}

WallSummary wall_in(credo_msg_WallSegment const& message) {
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
  object.covariance = Eigen::Map<RowMajor6d const>(message.covariance);
  object.evidence = evidence_in(message.evidence);
  object.label = label_in(message.label);
  return object;
}

StuffSummary stuff_in(credo_msg_StuffItem const& message) {
  return {message.stuff_id,         message.probability,           message.history_count,
          message.pixel_count,      get(message.centroid_world_m), get(message.min_world_m),
          get(message.max_world_m), evidence_in(message.evidence), label_in(message.label)};
}

}  // namespace credo
