#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/label.hpp"
#include "core/scores.hpp"
#include "eval/label_overlap.hpp"

namespace credo {

/// What a pixel is to the robot. A true object that it was not told of is stuff to it.
enum class PixelClass : std::uint8_t { kGround, kWall, kObject, kStuff };

/// Overlap of segments with true instances, over frames. Definitions: Richtsfeld et al. 2012 (OSD)
/// for over- and under-segmentation, Hoover's recall at an IoU of a half.
class OverlapScorer {
public:
  /// Frames without instances do not count.
  void add(LabelOverlap const& overlap, std::vector<LabelCode> const& instances);
  [[nodiscard]] std::optional<OverlapScores> scores() const;

private:
  OverlapScores sums_;
  std::uint64_t frames_ = 0;
};

/// IoU of the pixels of each class, pooled over frames.
class ClassScorer {
public:
  /// True labels that are not in `classes` count as none of them.
  void add(LabelOverlap const& overlap, std::map<LabelCode, PixelClass> const& classes);
  /// Only of classes that the truth has somewhere.
  [[nodiscard]] std::map<std::string, double> iou() const;

private:
  struct Counts {
    std::uint64_t both = 0;
    std::uint64_t truth = 0;
    std::uint64_t run = 0;
  };
  std::map<PixelClass, Counts> counts_;
};

}  // namespace credo
