#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace credo {

/// One pose of one object, as the joint choice sees it.
struct Explanation {
  /// Of the objects looked for; each is chosen once at most.
  std::size_t object = 0;
  /// Log-odds that the pose is right, if nothing else is there.
  double log_odds = 0.0;
  /// Pixels that it explains, rising.
  std::vector<std::uint32_t> pixels;
};

/// What a choice is worth: the log-odds of all its poses, less what they count for pixels that two
/// explain: each pose's log-odds are spread evenly over its pixels, and a pixel that two explain
/// counts for neither. Two poses in one place are so worth less than the better one, and things
/// that touch lose no more than their seam.
[[nodiscard]] double worth_of(std::vector<Explanation> const& explanations,
                              std::vector<std::size_t> const& chosen);

/// Positions of a choice, rising, that no pose added, taken away or put in another's place betters,
/// nor a pose added while another object makes room by another pose of its own: from nothing, by
/// the change that betters it most each time. Not always the best of all where many compete.
[[nodiscard]] std::vector<std::size_t> best_choice(std::vector<Explanation> const& explanations);

}  // namespace credo
