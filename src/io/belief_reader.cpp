#include <limits>

#include "io/belief_json.hpp"
#include "io/json_value.hpp"

namespace credo {
namespace {

constexpr std::uint64_t kMaxId = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMaxCount = std::numeric_limits<std::int64_t>::max();

std::optional<LabelCode> label_of(JsonValue const& value) {
  if (value.json.is_null()) {
    return std::nullopt;
  }
  return static_cast<LabelCode>(value.count(std::numeric_limits<LabelCode>::max()));
}

Evidence evidence_of(JsonValue const& value) {
  std::string const word = value.text();
  for (Evidence const evidence : {Evidence::kSeen, Evidence::kSeenThrough, Evidence::kOccluded,
                                  Evidence::kOutOfView, Evidence::kNotSeen}) {
    if (word == to_string(evidence)) {
      return evidence;
    }
  }
  value.refuse("'" + word + "' is no evidence");
}

/// May be -1, the prior.
FrameIndex belief_of(JsonValue const& value) {
  return value.json == -1 ? kPriorFrame : value.frame();
}

FloorSummary floor_of(JsonValue const& value) {
  return {value.at("normal").vector(), value.at("height_m").number(),
          value.at("points").count(kMaxCount)};
}

WallSummary wall_of(JsonValue const& value) {
  WallSummary wall;
  wall.id = static_cast<std::uint32_t>(value.at("id").count(kMaxId));
  auto const ends = value.at("segment").segment();
  wall.segment_start_m = ends[0];
  wall.segment_end_m = ends[1];
  wall.normal = value.at("normal").vector();
  wall.point_count = value.at("points").count(kMaxCount);
  wall.label = label_of(value.at("label"));
  return wall;
}

ObjectSummary object_of(JsonValue const& value) {
  ObjectSummary object;
  object.id = value.at("id").text();
  object.type = value.at("type").text();
  object.probability = value.at("probability").fraction();
  object.position_m = value.at("position").position();
  object.orientation = value.at("orientation_xyzw").orientation();
  auto const covariance = value.at("covariance").numbers<36>();
  object.covariance =
      Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor> const>(covariance.data());
  object.evidence = evidence_of(value.at("evidence"));
  object.label = label_of(value.at("label"));
  return object;
}

StuffSummary stuff_of(JsonValue const& value) {
  StuffSummary stuff;
  stuff.id = static_cast<std::uint32_t>(value.at("id").count(kMaxId));
  stuff.probability = value.at("probability").fraction();
  stuff.history_count = value.at("history").count(kMaxCount);
  stuff.pixel_count = value.at("points").count(kMaxCount);
  stuff.centroid_m = value.at("centroid").vector().cast<float>();
  stuff.min_m = value.at("min").vector().cast<float>();
  stuff.max_m = value.at("max").vector().cast<float>();
  stuff.evidence = evidence_of(value.at("evidence"));
  stuff.label = label_of(value.at("label"));
  return stuff;
}

BeliefSummary summary_in(JsonValue const& line) {
  if (line.at("schema").number() != 1) {
    line.at("schema").refuse("only 1 is known: written by another version of credo?");
  }
  BeliefSummary belief;
  belief.frame = line.at("frame").frame();
  belief.stamp_ns = line.at("stamp_ns").integer();
  belief.segmented_with = belief_of(line.at("segmented_with"));
  belief.T_world_camera = line.at("T_world_camera").matrix();
  if (JsonValue const floor = line.at("floor"); !floor.json.is_null()) {
    belief.floor = floor_of(floor);
  }
  line.at("walls").for_each([&](JsonValue const& v) { belief.walls.push_back(wall_of(v)); });
  line.at("objects").for_each([&](JsonValue const& v) { belief.objects.push_back(object_of(v)); });
  line.at("stuff").for_each([&](JsonValue const& v) { belief.stuff.push_back(stuff_of(v)); });
  return belief;
}

}  // namespace

std::vector<BeliefSummary> read_beliefs(std::filesystem::path const& path) {
  return read_frames(path, "beliefs", summary_in);
}

}  // namespace credo
