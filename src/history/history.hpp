#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/evidence.hpp"
#include "core/frame.hpp"

namespace credo {

// What became of each thing of a belief over a run, and why.

enum class ThingKind : std::uint8_t { kFloorPlane, kWallPlane, kObject, kStuff };

/// A frame of a run.
struct RunFrame {
  /// Among those that came out, from 0.
  std::size_t position = 0;
  FrameIndex frame{0};
  /// Since the first of them.
  double time_s = 0.0;
};

/// What was believed of a thing after one frame.
struct Moment {
  RunFrame at;
  double probability = 0.0;
  double log_odds = 0.0;
  Evidence evidence = Evidence::kNotSeen;
  Account why;
};

struct ThingHistory {
  ThingKind kind = ThingKind::kStuff;
  /// "floor", "wall:2", "stuff:7", or the id of a known object: with "object:" before it where it
  /// could be taken for one of these, or for a number.
  std::string name;
  /// Of a known object; else empty.
  std::string type;
  /// One for each frame in which the thing was believed, in order; never empty.
  std::vector<Moment> moments;
  /// The first frame after these in which it is not; none where the run ends with it.
  std::optional<RunFrame> gone;
  /// With what it became one in that frame, by name; empty where it did not.
  std::string joined;
};

/// Of each thing that the run ever believed: floor, walls, objects, stuff, each by its first frame.
/// A thing whose `why` was not told has an empty account.
[[nodiscard]] std::vector<ThingHistory> histories_of(std::vector<BeliefSummary> const& run);

/// Whether every thing of a belief tells why its probability moved: older versions wrote beliefs
/// that do not.
[[nodiscard]] bool tells_why(BeliefSummary const& belief);

/// Successive moments with the same evidence, in frames of the run that follow each other.
struct Span {
  /// The moments are those from `begin` on, before `end`.
  std::size_t begin = 0;
  std::size_t end = 0;
  Evidence evidence = Evidence::kNotSeen;
  /// Mean part of the points in each PointState; none where nothing is told of any point.
  std::optional<std::array<double, 5>> point_shares;
  double mean_visible_share = 0.0;
  /// Sums.
  double news = 0.0;
  double moved = 0.0;
  double log_odds_before = 0.0;
  double log_odds_after = 0.0;
  /// Moments in which it was bounded.
  std::size_t bounded = 0;
};

[[nodiscard]] std::vector<Span> spans_of(ThingHistory const& history);

/// "seen through": a word as people write it.
[[nodiscard]] std::string evidence_text(Evidence evidence);

/// How far log-odds travelled, up and down.
[[nodiscard]] double travelled(ThingHistory const& history);

/// The first moment whose log-odds are not, to within 1e-9, those of the frame before and what is
/// told to have moved them; none where all are.
[[nodiscard]] std::optional<std::size_t> first_unaccounted(ThingHistory const& history);

}  // namespace credo
