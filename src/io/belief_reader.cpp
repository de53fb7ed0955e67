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

int points_of(JsonValue const& value) {
  return static_cast<int>(value.count(std::numeric_limits<int>::max()));
}

Account account_of(JsonValue const& value) {
  Account why;
  why.points[PointState::kAgrees] = points_of(value.at("agrees"));
  why.points[PointState::kOccluded] = points_of(value.at("occluded"));
  why.points[PointState::kSeenThrough] = points_of(value.at("seen_through"));
  why.points[PointState::kUnmeasured] = points_of(value.at("no_depth"));
  why.points[PointState::kOutOfView] = points_of(value.at("out_of_view"));
  why.visible_share = value.at("visible_share").number();
  why.news = value.at("news").number();
  why.moved = value.at("moved").number();
  why.bounded = value.at("bounded").flag();
  return why;
}

/// Lines that older versions wrote have neither log-odds nor why.
template <typename Summary>
void read_why(JsonValue const& value, Summary& thing) {
  thing.log_odds = log_odds_of(thing.probability);
  if (value.has("why")) {
    if (JsonValue const log_odds = value.at("log_odds"); !log_odds.json.is_null()) {
      thing.log_odds = log_odds.number();
    }
    thing.why = account_of(value.at("why"));
  }
}

template <typename Summary>
void read_existence(JsonValue const& value, Summary& plane) {
  if (value.has("why")) {
    plane.probability = value.at("probability").fraction();
    plane.evidence = evidence_of(value.at("evidence"));
  }
  read_why(value, plane);
}

FloorSummary floor_of(JsonValue const& value) {
  FloorSummary floor;
  floor.normal = value.at("normal").vector();
  floor.height_m = value.at("height_m").number();
  floor.point_count = value.at("points").count(kMaxCount);
  read_existence(value, floor);
  return floor;
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
  read_existence(value, wall);
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
  read_why(value, object);
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
  read_why(value, stuff);
  if (value.has("joined")) {
    value.at("joined").for_each([&](JsonValue const& id) {
      stuff.joined_ids.push_back(static_cast<std::uint32_t>(id.count(kMaxId)));
    });
  }
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
