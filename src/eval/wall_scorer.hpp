#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/frame.hpp"
#include "core/label.hpp"
#include "core/scores.hpp"
#include "core/truth.hpp"
#include "eval/mean.hpp"

namespace credo {

/// Believed wall segments against what has been seen of the true ones. A true wall is to be found
/// from the frame on by which a hundredth of an image has shown it. A believed one is right where
/// it lies along a true one (10 degrees, 0.1 m) and at least half of it on what was seen of it: of
/// any of its faces that has been seen, as far as a wall is thick. Each true wall has one believed
/// wall at most, the one that covers most of it.
class WallScorer {
public:
  /// Where the true walls' pixels are, in a frame with or without a belief.
  void see(FrameTruth const& truth, LabelMap const& true_labels,
           CameraIntrinsics const& intrinsics);
  void add(BeliefSummary const& belief, FrameTruth const& truth);
  [[nodiscard]] WallScores scores() const;

private:
  struct Seen {
    /// Along the segment from its start.
    double low_m = 0.0;
    double high_m = 0.0;
    bool enough = false;
    /// As the truth tells them: the face towards the camera, a moment ago maybe the other one.
    std::vector<TrueWall> faces;
  };
  std::map<std::string, Seen> seen_;
  Mean precise_;
  Mean recalled_;
  Mean endpoint_m_;
};

}  // namespace credo
