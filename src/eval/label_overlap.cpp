#include "eval/label_overlap.hpp"

#include <limits>
#include <stdexcept>

namespace credo {

LabelOverlap::LabelOverlap(LabelMap const& labels, LabelMap const& true_labels) {
  if (!labels.same_size(true_labels)) {
    throw std::logic_error("LabelOverlap: label images of different sizes");
  }
  // Neighbours mostly have the same labels: a run of them is looked up once.
  for (std::size_t begin = 0; begin < labels.size();) {
    std::size_t end = begin + 1;
    while (end < labels.size() && labels[end] == labels[begin] &&
           true_labels[end] == true_labels[begin]) {
      ++end;
    }
    if (true_labels[begin] > 0) {
      add(true_labels[begin], labels[begin], end - begin);
    }
    begin = end;
  }
}

void LabelOverlap::add(LabelCode true_label, LabelCode label, std::uint64_t pixels) {
  common_[{true_label, label}] += pixels;
  true_sizes_[true_label] += pixels;
  sizes_[label] += pixels;
}

LabelOverlap LabelOverlap::with_merged_truth(
    std::function<LabelCode(LabelCode)> const& merged) const {
  LabelOverlap result;
  for (auto const& [labels, pixels] : common_) {
    result.add(merged(labels.first), labels.second, pixels);
  }
  return result;
}

std::uint64_t LabelOverlap::size(LabelCode label) const {
  auto const found = sizes_.find(label);
  return found == sizes_.end() ? 0 : found->second;
}

template <typename Better>
std::optional<LabelOverlap::Segment> LabelOverlap::segment_of(LabelCode true_label,
                                                              Better const& better) const {
  std::optional<Segment> best;
  auto const last = common_.upper_bound({true_label, std::numeric_limits<LabelCode>::max()});
  for (auto it = common_.lower_bound({true_label, kFloor}); it != last; ++it) {
    auto const& [labels, pixels] = *it;
    std::uint64_t const either = true_sizes_.at(true_label) + size(labels.second) - pixels;
    Segment const segment{labels.second, pixels,
                          static_cast<double>(pixels) / static_cast<double>(either)};
    if (!best || better(segment, *best)) {
      best = segment;
    }
  }
  return best;
}

std::optional<LabelOverlap::Segment> LabelOverlap::best_segment(LabelCode true_label) const {
  return segment_of(true_label, [](Segment const& a, Segment const& b) { return a.iou > b.iou; });
}

std::optional<LabelOverlap::Segment> LabelOverlap::largest_segment(LabelCode true_label) const {
  return segment_of(true_label,
                    [](Segment const& a, Segment const& b) { return a.common_px > b.common_px; });
}

std::map<LabelCode, LabelCode> LabelOverlap::bodies() const {
  std::map<LabelCode, LabelCode> bodies;
  std::map<LabelCode, std::uint64_t> most;
  for (auto const& [labels, pixels] : common_) {
    auto const& [true_label, label] = labels;
    if (label >= kFloor && pixels > most[label]) {
      most[label] = pixels;
      bodies[label] = true_label;
    }
  }
  return bodies;
}

}  // namespace credo
