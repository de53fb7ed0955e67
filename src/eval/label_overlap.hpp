#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "core/label.hpp"

namespace credo {

/// How the segments of a frame lie on its true instances. Only pixels that have a true label above
/// 0 count anywhere. Segments are labels from kFloor on: what is unassigned or without depth is
/// none.
class LabelOverlap {
public:
  /// Throws std::logic_error where the sizes differ.
  LabelOverlap(LabelMap const& labels, LabelMap const& true_labels);

  /// The same with some true labels taken as one: those that `merged` maps to the same.
  [[nodiscard]] LabelOverlap with_merged_truth(
      std::function<LabelCode(LabelCode)> const& merged) const;

  /// Pixels of each true label.
  [[nodiscard]] std::map<LabelCode, std::uint64_t> const& true_sizes() const { return true_sizes_; }
  /// Pixels that a true label and a label of the run have in common, where there are any.
  [[nodiscard]] std::map<std::pair<LabelCode, LabelCode>, std::uint64_t> const& common() const {
    return common_;
  }
  [[nodiscard]] std::uint64_t size(LabelCode label) const;

  struct Segment {
    LabelCode label = 0;
    std::uint64_t common_px = 0;
    double iou = 0.0;
  };
  /// The segment with the best IoU; none where no segment touches it. Of equals the lower label.
  [[nodiscard]] std::optional<Segment> best_segment(LabelCode true_label) const;
  /// The segment that covers most of it.
  [[nodiscard]] std::optional<Segment> largest_segment(LabelCode true_label) const;

  /// The true label of most pixels of each segment. Of equals the lower.
  [[nodiscard]] std::map<LabelCode, LabelCode> bodies() const;

private:
  LabelOverlap() = default;
  void add(LabelCode true_label, LabelCode label, std::uint64_t pixels);
  template <typename Better>
  [[nodiscard]] std::optional<Segment> segment_of(LabelCode true_label, Better const& better) const;

  std::map<std::pair<LabelCode, LabelCode>, std::uint64_t> common_;
  std::map<LabelCode, std::uint64_t> true_sizes_;
  std::map<LabelCode, std::uint64_t> sizes_;
};

}  // namespace credo
