#pragma once

#include <cstddef>
#include <deque>
#include <mutex>

#include "core/belief.hpp"

namespace credo {

/// The last few beliefs of a run, for frames that are segmented with an earlier one. Written by
/// fusion, read by detection, at the same time.
class BeliefTrail {
public:
  /// Remembers `lag` beliefs besides the newest.
  BeliefTrail(BeliefPtr prior, std::size_t lag);

  /// Frame `frame` has been counted, with this belief after it. Frames in order, none left out:
  /// anything else throws std::logic_error.
  void count(FrameIndex frame, BeliefPtr belief);
  /// Frames up to `last` have been counted and left the belief as it was.
  void count_lost_until(FrameIndex last);

  /// True once `frame` has been counted; frames before the first always are.
  [[nodiscard]] bool counted(FrameIndex frame) const;
  /// The belief when `frame` had been counted, the prior for any before the first. Throws
  /// std::logic_error where it has not been, or is longer ago than the lag.
  [[nodiscard]] BeliefPtr after(FrameIndex frame) const;
  [[nodiscard]] BeliefPtr newest() const;

private:
  void count_locked(FrameIndex frame, BeliefPtr belief);

  mutable std::mutex mutex_;
  BeliefPtr prior_;
  std::size_t kept_;
  FrameIndex last_ = kPriorFrame;
  /// Beliefs after the last frames, newest last.
  std::deque<BeliefPtr> beliefs_;
};

}  // namespace credo
