#include "eval/segmentation_scorer.hpp"

#include <optional>

namespace credo {
namespace {

std::optional<PixelClass> class_of_segment(LabelCode label) {
  if (label == kFloor) {
    return PixelClass::kGround;
  }
  if (is_wall(label)) {
    return PixelClass::kWall;
  }
  if (is_object(label)) {
    return PixelClass::kObject;
  }
  return is_stuff(label) ? std::optional(PixelClass::kStuff) : std::nullopt;
}

char const* name_of(PixelClass pixel_class) {
  switch (pixel_class) {
    case PixelClass::kGround:
      return "floor";
    case PixelClass::kWall:
      return "wall";
    case PixelClass::kObject:
      return "object";
    case PixelClass::kStuff:
      return "stuff";
  }
  return "";
}

}  // namespace

void OverlapScorer::add(LabelOverlap const& overlap, std::vector<LabelCode> const& instances) {
  double pixels = 0.0;
  double weighted_iou = 0.0;
  double covered = 0.0;
  double foreign = 0.0;
  double found = 0.0;
  double count = 0.0;
  for (LabelCode const instance : instances) {
    auto const size = overlap.true_sizes().find(instance);
    if (size == overlap.true_sizes().end()) {
      continue;
    }
    auto const own = static_cast<double>(size->second);
    pixels += own;
    count += 1.0;
    if (auto const best = overlap.best_segment(instance)) {
      weighted_iou += own * best->iou;
      found += best->iou > 0.5 ? 1.0 : 0.0;
    }
    if (auto const largest = overlap.largest_segment(instance)) {
      covered += static_cast<double>(largest->common_px);
      foreign += static_cast<double>(overlap.size(largest->label) - largest->common_px);
    }
  }
  if (count == 0.0) {
    return;
  }
  sums_.weighted_overlap += weighted_iou / pixels;
  sums_.over_segmentation += 1.0 - covered / pixels;
  sums_.under_segmentation += foreign / pixels;
  sums_.recall_50 += found / count;
  ++frames_;
}

std::optional<OverlapScores> OverlapScorer::scores() const {
  if (frames_ == 0) {
    return std::nullopt;
  }
  auto const n = static_cast<double>(frames_);
  return OverlapScores{sums_.weighted_overlap / n, sums_.over_segmentation / n,
                       sums_.under_segmentation / n, sums_.recall_50 / n};
}

void ClassScorer::add(LabelOverlap const& overlap, std::map<LabelCode, PixelClass> const& classes) {
  for (auto const& [labels, pixels] : overlap.common()) {
    auto const truth = classes.find(labels.first);
    auto const run = class_of_segment(labels.second);
    if (truth != classes.end()) {
      counts_[truth->second].truth += pixels;
    }
    if (run) {
      counts_[*run].run += pixels;
    }
    if (run && truth != classes.end() && truth->second == *run) {
      counts_[*run].both += pixels;
    }
  }
}

std::map<std::string, double> ClassScorer::iou() const {
  std::map<std::string, double> iou;
  for (auto const& [pixel_class, counts] : counts_) {
    if (counts.truth > 0) {
      std::uint64_t const either = counts.truth + counts.run - counts.both;
      iou[name_of(pixel_class)] = static_cast<double>(counts.both) / static_cast<double>(either);
    }
  }
  return iou;
}

}  // namespace credo
