#include "stages/fusion/findings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace credo {
namespace {

// Nothing is learnt from fewer points, or from a smaller part of what was ever seen at once. Of
// what never showed twice as many, half of it is enough.
constexpr double kLeastPoints = 8.0;
constexpr double kLeastOfSmall = 0.5;
constexpr double kUsuallySeen = 0.8;
constexpr double kLeastVisible = 0.1;
// Part of these points that is seen through.
constexpr double kMostThroughSeen = 0.35;
constexpr double kLeastThroughGone = 0.6;
constexpr double kLeastThroughSurelyGone = 0.85;
constexpr double kLeastVisibleSurelyGone = 0.3;

/// Of what is usually seen of it, the part that is seen or seen through.
double visible_share(PointCounts const& look, double most_agreeing) {
  int const told = look[PointState::kAgrees] + look[PointState::kSeenThrough];
  return std::min(1.0, told / (kUsuallySeen * std::max(1.0, most_agreeing)));
}

/// P(look | there) and P(look | not there).
std::pair<double, double> likelihoods(Finding const& finding) {
  double const s = std::min(1.0, finding.visible / 0.5);
  double const sure = 0.5 + 0.45 * s;
  switch (finding.verdict) {
    case Verdict::kSeen:
      return {sure, 1.0 - sure};
    case Verdict::kGone:
      return {1.0 - sure, sure};
    case Verdict::kSurelyGone:
      return {0.95 * std::exp(-5.25 * s), 0.95};
  }
  return {1.0, 1.0};
}

}  // namespace

double least_told(double most_agreeing) {
  return std::min(kLeastPoints, std::max(1.0, kLeastOfSmall * most_agreeing));
}

std::optional<Finding> finding_of(PointCounts const& look, double most_agreeing, bool matched) {
  int const agrees = look[PointState::kAgrees];
  int const told = agrees + look[PointState::kSeenThrough];
  double const visible = visible_share(look, most_agreeing);
  if (told < least_told(most_agreeing) || visible <= kLeastVisible) {
    return std::nullopt;
  }
  double const through = static_cast<double>(told - agrees) / told;
  if (matched || through < kMostThroughSeen) {
    return Finding{Verdict::kSeen, visible};
  }
  if (through > kLeastThroughSurelyGone && visible > kLeastVisibleSurelyGone) {
    return Finding{Verdict::kSurelyGone, visible};
  }
  if (through > kLeastThroughGone) {
    return Finding{Verdict::kGone, visible};
  }
  return std::nullopt;
}

double likelihood_ratio(Finding const& finding) {
  auto const [if_there, if_not] = likelihoods(finding);
  return if_there / if_not;
}

double log_odds_step(Finding const& finding, double counts) {
  auto const [if_there, if_not] = likelihoods(finding);
  return std::log((1.0 - counts + counts * if_there) / (1.0 - counts + counts * if_not));
}

void raise_to(StuffBelief& item, double least_log_odds) {
  double const before = item.log_odds;
  item.log_odds = std::max(before, least_log_odds);
  item.why.moved += item.log_odds - before;
}

void lower_to(StuffBelief& item, double most_log_odds) {
  double const before = item.log_odds;
  item.log_odds = std::min(before, most_log_odds);
  item.why.moved += item.log_odds - before;
}

Account account_of(PointCounts const& look, double most_agreeing) {
  return {.points = look, .visible_share = visible_share(look, most_agreeing)};
}

Account account_of_new(StuffModel const& model) {
  Account why;
  why.visible_share = 1.0;
  why.news = 1.0;
  why.points[PointState::kAgrees] = static_cast<int>(model.points.size());
  return why;
}

Evidence evidence_of(PointCounts const& look, std::optional<Finding> const& finding) {
  if (finding) {
    return finding->verdict == Verdict::kSeen ? Evidence::kSeen : Evidence::kSeenThrough;
  }
  int const hidden = look[PointState::kOccluded];
  int const out_of_view = look[PointState::kOutOfView];
  int const all = std::accumulate(look.by_state.begin(), look.by_state.end(), 0);
  int const rest = all - hidden - out_of_view;
  return out_of_view >= std::max(hidden, rest) ? Evidence::kOutOfView
         : hidden >= rest                      ? Evidence::kOccluded
                                               : Evidence::kNotSeen;
}

}  // namespace credo
