#include "stages/fusion/stuff_split.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "stages/fusion/stuff_model.hpp"

namespace credo {
namespace {

/// Looks, as far as they are news, and points of a cluster that must have had so many.
constexpr float kEnoughLooks = 3.0F;
constexpr double kShareOfPart = 0.6;
constexpr int kLeastPoints = 8;

}  // namespace

SplitModel split_model(StuffModel model, StuffLook const& look, LabelMap const& shown,
                       LabelCode largest, std::span<LabelCode const> labels, double news) {
  std::vector<LabelCode> shown_as(model.points.size(), kNoDepth);
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    if (look.points[p].state == PointState::kAgrees) {
      shown_as[p] = shown[static_cast<std::size_t>(look.points[p].block)];
      auto const more = static_cast<float>(shown_as[p] == largest ? -news : news);
      model.points[p].apart = std::max(0.0F, model.points[p].apart + more);
    }
  }
  SplitModel result;
  std::vector<std::uint8_t> gone(model.points.size(), 0);
  for (LabelCode const label : labels) {
    int points = 0;
    int apart = 0;
    for (std::size_t p = 0; p < model.points.size(); ++p) {
      bool const here = shown_as[p] == label;
      points += here ? 1 : 0;
      apart += here && model.points[p].apart > kEnoughLooks ? 1 : 0;
    }
    if (label == largest || points < kLeastPoints || apart <= kShareOfPart * points) {
      continue;
    }
    for (std::size_t p = 0; p < model.points.size(); ++p) {
      gone[p] = gone[p] != 0 || shown_as[p] == label ? 1 : 0;
    }
    result.parts.push_back(label);
  }
  result.model = without(std::move(model), gone);
  return result;
}

}  // namespace credo
