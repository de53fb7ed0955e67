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
/// One look that shows a point in the thing's main cluster undoes so many that do not.
constexpr float kOfOneTogether = 3.0F;
// Carving.
constexpr float kLeastMissed = 0.1F;
constexpr float kMissedBeforeItself = 0.2F;
constexpr float kMissedLessAgreeing = 0.5F;

bool is_one_of(LabelCode label, std::span<LabelCode const> labels) {
  return std::ranges::find(labels, label) != labels.end();
}

}  // namespace

void count_misses(StuffModel& model, StuffLook const& look, LabelMap const& shown,
                  std::span<LabelCode const> labels, double news) {
  float const missed = std::max(static_cast<float>(news), kLeastMissed);
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    PointLook const& point = look.points[p];
    float& count = model.points[p].missed;
    if (point.state == PointState::kAgrees) {
      count = std::max(0.0F, count - kMissedLessAgreeing);
    } else if (point.state == PointState::kSeenThrough) {
      bool const itself = is_one_of(shown[static_cast<std::size_t>(point.block)], labels);
      count += itself ? kMissedBeforeItself * missed : missed;
    }
  }
}

SplitModel split_model(StuffModel model, StuffLook const& look, LabelMap const& shown,
                       LabelCode main, std::span<LabelCode const> labels, double news) {
  auto const more = static_cast<float>(news);
  std::vector<LabelCode> shown_as(model.points.size(), kNoDepth);
  std::vector<std::uint8_t> gone(model.points.size(), 0);
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    if (look.points[p].state != PointState::kAgrees) {
      continue;
    }
    shown_as[p] = shown[static_cast<std::size_t>(look.points[p].block)];
    bool const own = is_one_of(shown_as[p], labels);
    if (!own && shown_as[p] < kFloor) {
      continue;
    }
    SurfacePoint& point = model.points[p];
    point.apart =
        std::max(0.0F, point.apart + (shown_as[p] == main ? -kOfOneTogether * more : more));
    bool const anothers = !own && point.apart > kEnoughLooks * point.weight / kMostWeight;
    gone[p] = anothers ? 1 : 0;
  }
  SplitModel result;
  for (LabelCode const label : labels) {
    int points = 0;
    int apart = 0;
    for (std::size_t p = 0; p < model.points.size(); ++p) {
      bool const here = shown_as[p] == label;
      points += here ? 1 : 0;
      apart += here && model.points[p].apart > kEnoughLooks ? 1 : 0;
    }
    if (label == main || points < kLeastPoints || apart <= kShareOfPart * points) {
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
