#include "io/scores_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace credo {
namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
Json json_of(std::optional<Value> const& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(OverlapScores const& scores) {
  return {{"wov", scores.weighted_overlap},
          {"f_os", scores.over_segmentation},
          {"f_us", scores.under_segmentation},
          {"recall_50", scores.recall_50}};
}

Json json_of(SegmentationScores const& scores) {
  Json json = {{"wov", nullptr}, {"f_os", nullptr}, {"f_us", nullptr}, {"recall_50", nullptr}};
  if (scores.instances) {
    json = json_of(*scores.instances);
  }
  json["iou"] = scores.iou.empty() ? Json(nullptr) : Json(scores.iou);
  json["merged"] = scores.merged ? json_of(*scores.merged) : Json(nullptr);
  return json;
}

Json json_of(ExistenceScores const& scores) {
  Json bins = Json::array();
  for (ReliabilityBin const& bin : scores.reliability) {
    bins.push_back({{"count", bin.count},
                    {"mean_probability", bin.count > 0 ? Json(bin.mean_probability) : Json()},
                    {"observed", bin.count > 0 ? Json(bin.observed) : Json()}});
  }
  return {{"ece", scores.ece}, {"brier", scores.brier}, {"reliability", std::move(bins)}};
}

Json json_of(std::optional<CameraScores> const& scores) {
  return scores ? Json{{"translation_m", scores->translation_m},
                       {"rotation_deg", scores->rotation_deg},
                       {"ate_m", scores->ate_m}}
                : Json{{"translation_m", nullptr}, {"rotation_deg", nullptr}, {"ate_m", nullptr}};
}

Json json_of(PoseClaim const& claim) {
  return {{"frame", number(claim.frame)},
          {"id", claim.object_id},
          {"squared_error", claim.squared_error},
          {"degrees_of_freedom", claim.degrees_of_freedom}};
}

Json json_of(Birth const& birth) {
  return {{"frame", number(birth.frame)},
          {"id", birth.stuff_id},
          {"thickness_blocks", birth.thickness_blocks},
          {"is_there", birth.is_there}};
}

Json json_of(Chance const& chance) {
  return {{"frame", number(chance.frame)},
          {"id", chance.object_id},
          {"visible_share", chance.visible_share},
          {"shown_px", chance.shown_px},
          {"is_found", chance.is_found}};
}

Json json_of(IdSwitch const& id_switch) {
  return {{"frame", number(id_switch.frame)},
          {"label", id_switch.body},
          {"from", id_switch.from_id},
          {"to", id_switch.to_id}};
}

/// Of each claim, birth, chance and switch.
template <typename Value>
Json array_of(std::vector<Value> const& values) {
  Json array = Json::array();
  for (Value const& value : values) {
    array.push_back(json_of(value));
  }
  return array;
}

Json json_of(ObjectScores const& objects) {
  return {{"translation_m", json_of(objects.translation_m)},
          {"rotation_deg", json_of(objects.rotation_deg)},
          {"adds_recall", json_of(objects.adds_recall)},
          {"nees", json_of(objects.nees)},
          {"nees_expected", json_of(objects.nees_expected)},
          {"nees_low", json_of(objects.nees_low)},
          {"nees_high", json_of(objects.nees_high)},
          {"nees_inside", json_of(objects.nees_inside())},
          {"nees_repeated_low", json_of(objects.nees_repeated_low)},
          {"nees_repeated_high", json_of(objects.nees_repeated_high)},
          {"nees_claims", json_of(objects.nees_claims)},
          {"precision", json_of(objects.precision)},
          {"recall", json_of(objects.recall)},
          {"claims", array_of(objects.claims)}};
}

}  // namespace

std::string scores_json(Scores const& scores) {
  Json json = {{"schema", 1}, {"frames", scores.frames}};
  json["camera"] = json_of(scores.camera);
  json["camera_told"] = json_of(scores.camera_told);
  json["segmentation"] = json_of(scores.segmentation);
  json["floor"] = {{"tilt_deg", nullptr}, {"height_m", nullptr}};
  if (scores.floor) {
    json["floor"] = {{"tilt_deg", scores.floor->tilt_deg}, {"height_m", scores.floor->height_m}};
  }
  json["walls"] = {{"precision", json_of(scores.walls.precision)},
                   {"recall", json_of(scores.walls.recall)},
                   {"endpoint_m", json_of(scores.walls.endpoint_m)}};
  json["objects"] = json_of(scores.objects);
  json["existence"] = {{"ece", nullptr}, {"brier", nullptr}, {"reliability", nullptr}};
  if (scores.existence) {
    json["existence"] = json_of(*scores.existence);
  }
  json["change"] = {{"precision", json_of(scores.change.precision)},
                    {"recall", json_of(scores.change.recall)},
                    {"delay_frames", json_of(scores.change.delay_frames)},
                    {"events", scores.change.events}};
  json["stuff"] = {{"id_switches", nullptr},
                   {"fragmentations", nullptr},
                   {"item_frames", nullptr},
                   {"switches", nullptr}};
  if (scores.stuff) {
    json["stuff"] = {{"id_switches", scores.stuff->switches.size()},
                     {"fragmentations", scores.stuff->fragmentations},
                     {"item_frames", scores.stuff->item_frames},
                     {"switches", array_of(scores.stuff->switches)}};
  }
  json["births"] = array_of(scores.births);
  json["chances"] = array_of(scores.chances);
  return json.dump(2);
}

}  // namespace credo
