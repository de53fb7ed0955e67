#include "measures.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace credo {
namespace {

std::optional<LabelCode> code_of(FrameTruth const& truth, std::string const& name) {
  auto const among = [&](auto const& things) -> std::optional<LabelCode> {
    auto const found = std::ranges::find(things, name, [](auto const& thing) { return thing.id; });
    return found != things.end() ? std::optional(found->label) : std::nullopt;
  };
  if (name == "floor") {
    return kFloor;
  }
  for (auto const& code : {among(truth.walls), among(truth.objects), among(truth.stuff)}) {
    if (code) {
      return code;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string true_name(FrameTruth const& truth, LabelCode label) {
  if (label == kFloor) {
    return "floor";
  }
  for (TrueWall const& wall : truth.walls) {
    if (wall.label == label) {
      return wall.id;
    }
  }
  for (auto const* things : {&truth.objects, &truth.stuff}) {
    for (TrueThing const& thing : *things) {
      if (thing.label == label) {
        return thing.id;
      }
    }
  }
  return "nothing";
}

double best_iou(SceneLook const& look, std::string const& name, WantedLabel const& wanted) {
  std::optional<LabelCode> const code = code_of(look.truth, name);
  if (!code) {
    return 0.0;
  }
  LabelMap const& ours = look.segmentation->labels;
  std::map<LabelCode, std::pair<double, double>> sizes;  // of ours: in both, all of it
  double all = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    double const is = look.true_labels[i] == *code ? 1.0 : 0.0;
    auto& [both, size] = sizes[ours[i]];
    all += is;
    both += is;
    size += 1.0;
  }
  double best = 0.0;
  for (auto const& [label, size] : sizes) {
    if (wanted(label) && all > 0.0) {
      best = std::max(best, size.first / (all + size.second - size.first));
    }
  }
  return best;
}

StuffShare share_that_is_stuff(SceneLook const& look, std::string const& name) {
  std::optional<LabelCode> const code = code_of(look.truth, name);
  StuffShare share;
  for (std::size_t i = 0; code && i < look.true_labels.size(); ++i) {
    if (look.true_labels[i] == *code) {
      ++share.pixels;
      share.stuff_pixels += is_stuff(look.segmentation->labels[i]) ? 1U : 0U;
    }
  }
  return share;
}

std::string true_name_of_label(SceneLook const& look, LabelCode label) {
  std::map<LabelCode, std::size_t> counts;
  for (std::size_t i = 0; i < look.true_labels.size(); ++i) {
    if (look.segmentation->labels[i] == label) {
      ++counts[look.true_labels[i]];
    }
  }
  auto const most =
      std::ranges::max_element(counts, {}, [](auto const& entry) { return entry.second; });
  return most == counts.end() ? "nothing" : true_name(look.truth, most->first);
}

std::vector<StuffTrack> stuff_tracks(SceneRun const& run) {
  std::map<std::uint32_t, StuffTrack> tracks;
  for (std::size_t k = 0; k < run.looks.size(); ++k) {
    SceneLook const& look = run.looks[k];
    for (StuffBelief const& stuff : look.belief->stuff) {
      auto const [found, is_new] = tracks.try_emplace(stuff.id);
      StuffTrack& track = found->second;
      if (is_new) {
        track.id = stuff.id;
        track.first = k;
        track.what = stuff.label ? true_name_of_label(look, *stuff.label) : "nothing";
        track.probability.resize(run.looks.size());
        track.seen.resize(run.looks.size(), false);
      }
      track.most_pixels = std::max(track.most_pixels, stuff.latest().pixel_count);
      track.probability[k] = probability_of(stuff.log_odds);
      track.seen[k] = stuff.label.has_value();
    }
  }
  std::vector<StuffTrack> result;
  result.reserve(tracks.size());
  for (auto& [id, track] : tracks) {
    result.push_back(std::move(track));
  }
  return result;
}

}  // namespace credo
