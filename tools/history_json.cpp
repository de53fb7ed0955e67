#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/belief.hpp"
#include "history_text.hpp"

namespace credo {
namespace {

using Json = nlohmann::ordered_json;

Json shares_json(std::optional<std::array<double, 5>> const& shares) {
  if (!shares) {
    return nullptr;
  }
  auto const share = [&](PointState state) { return shares->at(static_cast<std::size_t>(state)); };
  return {{"agrees", share(PointState::kAgrees)},
          {"occluded", share(PointState::kOccluded)},
          {"seen_through", share(PointState::kSeenThrough)},
          {"no_depth", share(PointState::kUnmeasured)},
          {"out_of_view", share(PointState::kOutOfView)}};
}

Json span_json(ThingHistory const& history, Span const& span) {
  Moment const& first = history.moments[span.begin];
  Moment const& last = history.moments[span.end - 1];
  return {{"frames", {number(first.at.frame), number(last.at.frame)}},
          {"time_s", {first.at.time_s, last.at.time_s}},
          {"evidence", to_string(span.evidence)},
          {"points", shares_json(span.point_shares)},
          {"visible_share", span.mean_visible_share},
          {"news", span.news},
          {"moved", span.moved},
          {"log_odds", {span.log_odds_before, span.log_odds_after}},
          {"probability", {probability_of(span.log_odds_before), last.probability}},
          {"bounded_frames", span.bounded}};
}

Json thing_json(ThingHistory const& history) {
  static constexpr std::array<char const*, 4> kKinds = {"floor", "wall", "object", "stuff"};
  Moment const& last = history.moments.back();
  return {{"id", history.name},
          {"kind", kKinds.at(static_cast<std::size_t>(history.kind))},
          {"type", history.type.empty() ? Json(nullptr) : Json(history.type)},
          {"first_frame", number(history.moments.front().at.frame)},
          {"last_frame", number(last.at.frame)},
          {"gone_frame", history.gone ? Json(number(history.gone->frame)) : Json(nullptr)},
          {"joined", history.joined.empty() ? Json(nullptr) : Json(history.joined)},
          {"probability", last.probability},
          {"log_odds", last.log_odds},
          {"evidence", to_string(last.evidence)},
          {"travelled", travelled(history)}};
}

std::string line_of(Json const& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string history_json(ThingHistory const& history) {
  Json json = thing_json(history);
  json["spans"] = Json::array();
  for (Span const& span : spans_of(history)) {
    json["spans"].push_back(span_json(history, span));
  }
  return line_of(json);
}

std::string histories_json(std::vector<ThingHistory> const& histories) {
  Json json = Json::array();
  for (ThingHistory const& history : histories) {
    json.push_back(thing_json(history));
  }
  return line_of(json);
}

}  // namespace credo
