#include "stages/fusion/stuff_findings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/fusion/existence.hpp"

namespace credo {
namespace {

// Nothing is learnt from fewer points, or from a smaller part of what was ever seen at once.
constexpr int kLeastPoints = 8;
constexpr double kUsuallySeen = 0.8;
constexpr double kLeastVisible = 0.1;
// Part of these points that is seen through.
constexpr double kMostThroughSeen = 0.35;
constexpr double kLeastThroughGone = 0.6;
constexpr double kLeastThroughSurelyGone = 0.85;
constexpr double kLeastVisibleSurelyGone = 0.3;

/// Of what is usually seen of it, the part that is seen or seen through.
double visible_share(StuffLook const& look, double most_agreeing) {
  int const told = look.counts[PointState::kAgrees] + look.counts[PointState::kSeenThrough];
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

std::optional<Finding> finding_of(StuffLook const& look, double most_agreeing, bool matched) {
  int const agrees = look.counts[PointState::kAgrees];
  int const told = agrees + look.counts[PointState::kSeenThrough];
  double const visible = visible_share(look, most_agreeing);
  if (told < kLeastPoints || visible <= kLeastVisible) {
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

void believe(StuffBelief& item, Finding const& finding, Look const& now, double news,
             ExistenceConfig const& config) {
  auto const [if_there, if_not] = likelihoods(finding);
  bool const changed = (finding.verdict == Verdict::kSeen) != (item.verdict == Verdict::kSeen);
  double const k = changed ? 1.0 : news;
  double const before = item.log_odds;
  double const updated = before + std::log((1.0 - k + k * if_there) / (1.0 - k + k * if_not));
  item.log_odds = bounded_log_odds(updated, config);
  item.why.news = k;
  item.why.moved = item.log_odds - before;
  item.why.bounded = item.log_odds != updated;
  item.verdict = finding.verdict;
  item.last_look = now;
}

void raise_to(StuffBelief& item, double least_log_odds) {
  double const before = item.log_odds;
  item.log_odds = std::max(before, least_log_odds);
  item.why.moved += item.log_odds - before;
}

Account account_of(StuffLook const& look, double most_agreeing) {
  return {.points = look.counts, .visible_share = visible_share(look, most_agreeing)};
}

Account account_of_new(StuffModel const& model) {
  Account why;
  why.visible_share = 1.0;
  why.news = 1.0;
  why.points[PointState::kAgrees] = static_cast<int>(model.points.size());
  return why;
}

Evidence evidence_of(StuffLook const& look, std::optional<Finding> const& finding) {
  if (finding) {
    return finding->verdict == Verdict::kSeen ? Evidence::kSeen : Evidence::kSeenThrough;
  }
  int const hidden = look.counts[PointState::kOccluded];
  int const out_of_view = look.counts[PointState::kOutOfView];
  int const rest = static_cast<int>(look.points.size()) - hidden - out_of_view;
  return out_of_view >= std::max(hidden, rest) ? Evidence::kOutOfView
         : hidden >= rest                      ? Evidence::kOccluded
                                               : Evidence::kNotSeen;
}

}  // namespace credo
