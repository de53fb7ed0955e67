#include "io/belief_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace credo {
namespace {

using Json = nlohmann::ordered_json;

template <typename Vector>
Json numbers(Vector const& v) {
  Json array = Json::array();
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    array.push_back(static_cast<double>(v(i)));
  }
  return array;
}

template <typename Matrix>
Json rows(Matrix const& m) {
  Json array = Json::array();
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
      array.push_back(m(r, c));
    }
  }
  return array;
}

Json label_json(std::optional<LabelCode> const& label) {
  return label ? Json(*label) : Json(nullptr);
}

Json why_json(Account const& why) {
  return {{"agrees", why.points[PointState::kAgrees]},
          {"occluded", why.points[PointState::kOccluded]},
          {"seen_through", why.points[PointState::kSeenThrough]},
          {"no_depth", why.points[PointState::kUnmeasured]},
          {"out_of_view", why.points[PointState::kOutOfView]},
          {"visible_share", why.visible_share},
          {"news", why.news},
          {"moved", why.moved},
          {"bounded", why.bounded}};
}

/// What an older version did not tell stays untold.
template <typename Summary>
void add_why(Json& json, Summary const& thing) {
  if (thing.why) {
    // JSON has no infinity; the probability tells which it is.
    json["log_odds"] = std::isfinite(thing.log_odds) ? Json(thing.log_odds) : Json();
    json["why"] = why_json(*thing.why);
  }
}

/// Of floor and walls, which older versions did not doubt.
template <typename Summary>
void add_existence(Json& json, Summary const& plane) {
  if (plane.why) {
    json["probability"] = plane.probability;
    json["evidence"] = to_string(plane.evidence);
  }
  add_why(json, plane);
}

Json floor_json(FloorSummary const& floor) {
  Json json = {{"normal", numbers(floor.normal)},
               {"height_m", floor.height_m},
               {"points", floor.point_count}};
  add_existence(json, floor);
  return json;
}

Json wall_json(WallSummary const& wall) {
  Json json = {
      {"id", wall.id},
      {"segment", Json::array({numbers(wall.segment_start_m), numbers(wall.segment_end_m)})},
      {"normal", numbers(wall.normal)},
      {"points", wall.point_count},
      {"label", label_json(wall.label)}};
  add_existence(json, wall);
  return json;
}

Json object_json(ObjectSummary const& object) {
  Json json = {{"id", object.id},
               {"type", object.type},
               {"probability", object.probability},
               {"position", numbers(object.position_m)},
               {"orientation_xyzw", numbers(object.orientation.coeffs())},
               {"covariance", rows(object.covariance)},
               {"evidence", to_string(object.evidence)},
               {"label", label_json(object.label)}};
  add_why(json, object);
  return json;
}

Json stuff_json(StuffSummary const& stuff) {
  Json json = {{"id", stuff.id},
               {"probability", stuff.probability},
               {"history", stuff.history_count},
               {"points", stuff.pixel_count},
               {"centroid", numbers(stuff.centroid_m)},
               {"min", numbers(stuff.min_m)},
               {"max", numbers(stuff.max_m)},
               {"evidence", to_string(stuff.evidence)},
               {"label", label_json(stuff.label)}};
  add_why(json, stuff);
  if (!stuff.joined_ids.empty()) {
    json["joined"] = stuff.joined_ids;
  }
  return json;
}

template <typename T, typename ToJson>
Json list(std::vector<T> const& values, ToJson const& to_json) {
  Json array = Json::array();
  for (T const& value : values) {
    array.push_back(to_json(value));
  }
  return array;
}

}  // namespace

std::string belief_json(BeliefSummary const& belief) {
  Json const line = {{"schema", 1},
                     {"frame", number(belief.frame)},
                     {"stamp_ns", belief.stamp_ns},
                     {"segmented_with", number(belief.segmented_with)},
                     {"T_world_camera", rows(belief.T_world_camera)},
                     {"floor", belief.floor ? floor_json(*belief.floor) : Json(nullptr)},
                     {"walls", list(belief.walls, wall_json)},
                     {"objects", list(belief.objects, object_json)},
                     {"stuff", list(belief.stuff, stuff_json)}};
  // Ids come from files that people write: a broken character must not cost the frame.
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace credo
