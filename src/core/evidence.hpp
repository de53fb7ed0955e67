#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace credo {

/// Why a probability moved, or did not, in the last frame.
enum class Evidence : std::uint8_t { kSeen, kSeenThrough, kOccluded, kOutOfView, kNotSeen };

/// The word that files and topics use: "seen", "seen_through", "occluded", "out_of_view",
/// "not_seen".
[[nodiscard]] char const* to_string(Evidence evidence);

/// What a frame says of one point of a surface.
enum class PointState : std::uint8_t {
  kOutOfView,
  kUnmeasured,
  /// Something is measured where it is believed to be.
  kAgrees,
  /// Something nearer hides it; or is so near beside it that it might.
  kOccluded,
  kSeenThrough,
};

/// How many points of a surface a frame says what of.
struct PointCounts {
  /// By PointState.
  std::array<int, 5> by_state{};

  [[nodiscard]] int& operator[](PointState state) {
    return by_state[static_cast<std::size_t>(state)];
  }
  [[nodiscard]] int operator[](PointState state) const {
    return by_state[static_cast<std::size_t>(state)];
  }
  friend bool operator==(PointCounts const&, PointCounts const&) = default;
};

/// By how much the last frame moved the probability that a thing is there, and for what.
struct Account {
  /// Of what is believed of its surface.
  PointCounts points;
  /// The part of it that the frame tells of, of what can be seen at once; 0 where that is nothing.
  double visible_share = 0.0;
  /// How much of the frame is news about it, in [0, 1].
  double news = 0.0;
  /// Added to its log-odds.
  double moved = 0.0;
  /// Whether it would have been more if log-odds had no bound.
  bool bounded = false;
};

}  // namespace credo
