#include "stages/fusion/stuff/one_with.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stages/fusion/stuff/model.hpp"

namespace credo {
namespace {

// Evidence that two are one counts in looks, as far as these are news.
constexpr double kEnoughToBeKnown = 3.0;
constexpr double kEnoughToMerge = 1.4;
constexpr double kOfOneTogether = 2.5;
constexpr double kOfOneApart = 0.5;
constexpr double kLongAlone = 1.0;
// The same of what shows in fewer blocks than that: several small things often show as one.
constexpr int kSmallBlocks = 100;
constexpr double kLongAloneOfSmall = 2.5;
constexpr double kInsideOfHundred = 0.625;

OneWith& entry_of(StuffBelief& item, std::uint32_t id, double at_first) {
  auto const found = std::ranges::find(item.one_with, id, &OneWith::id);
  return found != item.one_with.end() ? *found : item.one_with.emplace_back(OneWith{id, at_first});
}

double total_weight(StuffModel const& model) {
  double sum = 0.0;
  for (SurfacePoint const& point : model.points) {
    sum += static_cast<double>(point.weight);
  }
  return sum;
}

/// Of what is small in the image the looks that told it from others: its points are too few, and
/// too often new, to tell how often it was seen.
double evidence_at_first(StuffBelief const& item, int blocks) {
  auto const most = static_cast<double>(kMostWeight);
  if (blocks < kSmallBlocks) {
    return -kLongAloneOfSmall * std::min(most, static_cast<double>(item.history_count)) / most;
  }
  double const points = static_cast<double>(std::max<std::size_t>(item.model->points.size(), 1));
  return -kLongAlone * total_weight(*item.model) / points / most;
}

/// Of the points that agree and of which the rest holds.
template <typename Rest>
double amount_where(StuffModel const& model, StuffLook const& look, Rest const& rest) {
  double sum = 0.0;
  for (std::size_t p = 0; p < look.points.size(); ++p) {
    if (look.points[p].state == PointState::kAgrees && rest(look.points[p])) {
      sum += static_cast<double>(model.points[p].weight);
    }
  }
  auto const spacing_m = static_cast<double>(model.spacing_m);
  return sum * spacing_m * spacing_m;
}

}  // namespace

double counts_as_one(int blocks) {
  // As if it were a square: of that, what is not at its edge.
  double const across = std::sqrt(static_cast<double>(blocks));
  double const inside = std::max(0.0, across - 2.0) / std::max(1.0, across);
  return inside * inside / kInsideOfHundred;
}

bool shows_as_one(StuffBelief& item, std::uint32_t id, double news, int blocks) {
  OneWith& entry = entry_of(item, id, evidence_at_first(item, blocks));
  entry.evidence += kOfOneTogether * news;
  return entry.evidence > kEnoughToMerge;
}

bool shows_as_known(StuffBelief& item, double news) {
  OneWith& entry = entry_of(item, kKnownThings, 0.0);
  entry.evidence += news;
  return entry.evidence > kEnoughToBeKnown;
}

void shows_alone(StuffBelief& item, std::vector<StuffBelief> const& stuff, double news) {
  for (OneWith& entry : item.one_with) {
    auto const other = std::ranges::find(stuff, entry.id, &StuffBelief::id);
    if (entry.id == kKnownThings) {
      entry.evidence -= news;
    } else if (other == stuff.end() || other->label) {
      entry.evidence -= kOfOneApart * news;
    }
  }
  std::erase_if(item.one_with, [](OneWith const& entry) {
    return entry.evidence <= (entry.id == kKnownThings ? 0.0 : -kLongAlone);
  });
}

double amount_shown(StuffModel const& model, StuffLook const& look) {
  return amount_where(model, look, [](PointLook const&) { return true; });
}

double amount_shown(StuffModel const& model, StuffLook const& look, LabelMap const& shown,
                    LabelCode label) {
  return amount_where(model, look, [&](PointLook const& point) {
    return shown[static_cast<std::size_t>(point.block)] == label;
  });
}

}  // namespace credo
