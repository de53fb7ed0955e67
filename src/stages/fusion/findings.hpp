#pragma once

#include <optional>

#include "core/belief.hpp"
#include "stages/fusion/existence.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {

/// A look at a thing that says something about it.
struct Finding {
  Verdict verdict = Verdict::kSeen;
  /// Of what is usually seen of it, the part that is seen now, or seen through.
  double visible = 0.0;
  /// Of what has gone as a thing of its own alone: its surface is where it was, and the frame takes
  /// it for something known.
  bool stands = false;
};

/// What a look says of a thing of which so many points ever agreed with one frame; `matched`: one
/// of the frame's clusters is taken for it, which a pose that is not quite right does not undo.
/// None where too little of it is seen or seen through, or about as much of both.
[[nodiscard]] std::optional<Finding> finding_of(PointCounts const& look, double most_agreeing,
                                                bool matched);

/// How many points a look must tell of for anything to be learnt of a thing of which so many ever
/// agreed with one frame.
[[nodiscard]] double least_told(double most_agreeing);

/// How much likelier the finding is if the thing is there.
[[nodiscard]] double likelihood_ratio(Finding const& finding);

/// What it adds to the log-odds where the part `counts` of the look is evidence (existence.hpp).
[[nodiscard]] double log_odds_step(Finding const& finding, double counts);

/// Of a thing, a wall or the floor: Bayes' rule in log-odds, bounded. The more of a thing is seen,
/// or seen through, the more it counts; what a look repeats of the one before counts by `news`
/// (novelty), a change in full. Another name for what stands as before is no change in the world.
/// The thing's account has that part, and by how much it moved.
template <typename Thing>
void believe(Thing& thing, Finding const& finding, Look const& now, double news,
             ExistenceConfig const& config) {
  Verdict const shown = finding.stands ? Verdict::kSeen : finding.verdict;
  bool const changed =
      !finding.stands && (shown == Verdict::kSeen) != (thing.verdict == Verdict::kSeen);
  thing.why.news = changed ? 1.0 : news;
  double const step = log_odds_step(finding, thing.why.news);
  add_step(thing.log_odds, step, thing.why, config);
  thing.verdict = shown;
  thing.last_look = now;
}

/// Believes a thing at least, or at most, so much, and puts the jump to its account.
void raise_to(StuffBelief& item, double least_log_odds);
void lower_to(StuffBelief& item, double most_log_odds);

/// Of a look by itself: it has moved nothing yet.
[[nodiscard]] Account account_of(PointCounts const& look, double most_agreeing);
/// Of a thing that was made of what is seen: all of it is.
[[nodiscard]] Account account_of_new(StuffModel const& model);

/// Why its probability moved, or, without a finding, did not: by what most of its points met.
[[nodiscard]] Evidence evidence_of(PointCounts const& look, std::optional<Finding> const& finding);

}  // namespace credo
