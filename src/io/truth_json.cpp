#include "io/truth_json.hpp"

#include <nlohmann/json.hpp>
#include <vector>

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

}  // namespace credo
