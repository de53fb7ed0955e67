#include "io/truth_json.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "io/json_value.hpp"

namespace credo {
namespace {

using Json = nlohmann::ordered_json;

template <typename Vector>
Json numbers(Vector const& v) {
  return std::vector<double>(v.data(), v.data() + v.size());
}

Json thing_json(TrueThing const& thing) {
  return {{"id", thing.id},
          {"type", thing.type},
          {"position", numbers(thing.pose.translation())},
          {"orientation_xyzw", numbers(thing.pose.rotation().coeffs())},
          {"present", thing.present},
          {"visible_fraction", thing.visible_fraction},
          {"label", thing.label}};
}

Json things_json(std::vector<TrueThing> const& things) {
  Json array = Json::array();
  for (TrueThing const& thing : things) {
    array.push_back(thing_json(thing));
  }
  return array;
}

template <typename Each>
void for_each_in(JsonValue const& line, std::string const& key, Each const& each) {
  if (line.has(key)) {
    line.at(key).for_each(each);
  }
}

LabelCode label_of(JsonValue const& value) {
  return static_cast<LabelCode>(value.count(std::numeric_limits<LabelCode>::max()));
}

TrueFloor floor_of(JsonValue const& value) {
  TrueFloor floor;
  floor.normal = value.at("normal").vector();
  floor.height_m = value.at("height_m").number();
  return floor;
}

TrueWall wall_of(JsonValue const& value) {
  TrueWall wall;
  wall.id = value.at("id").text();
  auto const ends = value.at("segment").segment();
  wall.segment_start_m = ends[0];
  wall.segment_end_m = ends[1];
  wall.normal = value.at("normal").vector();
  wall.visible_fraction = value.at("visible_fraction").fraction();
  wall.label = label_of(value.at("label"));
  return wall;
}

TrueThing thing_of(JsonValue const& value) {
  TrueThing thing;
  thing.id = value.at("id").text();
  // Stuff has none.
  if (JsonValue const type = value.at("type"); type.json != "") {
    thing.type = type.text();
  }
  thing.pose = Se3(value.at("orientation_xyzw").orientation(), value.at("position").position());
  thing.present = value.at("present").flag();
  thing.visible_fraction = value.at("visible_fraction").fraction();
  thing.label = label_of(value.at("label"));
  return thing;
}

TrueEvent event_of(JsonValue const& value) {
  TrueEvent event{value.at("what").text(), value.at("id").text()};
  if (event.what != "appeared" && event.what != "moved" && event.what != "removed") {
    value.at("what").refuse("must be appeared, moved or removed");
  }
  return event;
}

FrameTruth truth_in(JsonValue const& line) {
  FrameTruth truth;
  truth.frame = line.at("frame").frame();
  truth.stamp_ns = line.at("stamp_ns").integer();
  auto const pose = line.at("T_world_camera").numbers<16>();
  truth.T_world_camera =
      Se3::from_matrix(Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor> const>(pose.data()));
  if (line.has("floor") && !line.at("floor").json.is_null()) {
    truth.floor = floor_of(line.at("floor"));
  }
  for_each_in(line, "walls", [&](JsonValue const& v) { truth.walls.push_back(wall_of(v)); });
  for_each_in(line, "objects", [&](JsonValue const& v) { truth.objects.push_back(thing_of(v)); });
  for_each_in(line, "stuff", [&](JsonValue const& v) { truth.stuff.push_back(thing_of(v)); });
  for_each_in(line, "events", [&](JsonValue const& v) { truth.events.push_back(event_of(v)); });
  return truth;
}

}  // namespace

std::string truth_json(FrameTruth const& truth) {
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> const T_world_camera = truth.T_world_camera.matrix();
  Json json = {{"schema", 1},
               {"frame", number(truth.frame)},
               {"stamp_ns", truth.stamp_ns},
               {"T_world_camera", numbers(T_world_camera)},
               {"floor", nullptr},
               {"walls", Json::array()},
               {"objects", things_json(truth.objects)},
               {"stuff", things_json(truth.stuff)},
               {"events", Json::array()}};
  if (truth.floor) {
    json["floor"] = {{"normal", numbers(truth.floor->normal)},
                     {"height_m", truth.floor->height_m},
                     {"label", kFloor}};
  }
  for (TrueWall const& wall : truth.walls) {
    json["walls"].push_back(
        {{"id", wall.id},
         {"segment", Json::array({numbers(wall.segment_start_m), numbers(wall.segment_end_m)})},
         {"normal", numbers(wall.normal)},
         {"visible_fraction", wall.visible_fraction},
         {"label", wall.label}});
  }
  for (TrueEvent const& event : truth.events) {
    json["events"].push_back({{"what", event.what}, {"id", event.id}});
  }
  return json.dump();
}

std::vector<FrameTruth> read_truth(std::filesystem::path const& path) {
  return read_frames(path, "true beliefs", truth_in);
}

}  // namespace credo
