#include "stages/segments/settling.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "geometry/segment_shares.hpp"

namespace credo {
namespace {

/// Whose a segment is.
struct Owners {
  std::map<LabelCode, std::uint32_t> objects;
  std::uint32_t pixels = 0;

  [[nodiscard]] std::uint32_t held_px() const {
    std::uint32_t sum = 0;
    for (auto const& [label, count] : objects) {
      sum += count;
    }
    return sum;
  }
  /// Of equals the lower label.
  [[nodiscard]] LabelCode largest() const {
    return std::ranges::max_element(objects, {}, [](auto const& one) { return one.second; })->first;
  }
};

std::vector<Owners> owners_of(Segmentation const& segmentation) {
  std::vector<Owners> owners(segmentation.segments.pixel_counts.size() + 1);
  for (std::size_t i = 0; i < segmentation.labels.size(); ++i) {
    Owners& owner = owners[static_cast<std::size_t>(segmentation.segments.labels[i])];
    LabelCode const label = segmentation.labels[i];
    owner.pixels += 1;
    if (is_object(label)) {
      ++owner.objects[label];
    }
  }
  return owners;
}

/// What becomes of a pixel of a segment.
LabelCode settled(LabelCode label, Owners const& owner) {
  double const share = static_cast<double>(owner.held_px()) / static_cast<double>(owner.pixels);
  if (label == kUnassigned && share >= kMostlyShare) {
    return owner.largest();
  }
  return is_object(label) && share <= kHardlyShare ? kUnassigned : label;
}

}  // namespace

Segmentation settle_objects(Segmentation segmentation) {
  if (segmentation.segments.labels.empty() || segmentation.objects.empty()) {
    return segmentation;
  }
  std::vector<Owners> const owners = owners_of(segmentation);
  std::map<LabelCode, std::size_t> pixel_counts;
  for (std::size_t i = 0; i < segmentation.labels.size(); ++i) {
    auto const segment = static_cast<std::size_t>(segmentation.segments.labels[i]);
    LabelCode& label = segmentation.labels[i];
    // Segment 0 is what belongs to none.
    if (segment > 0 && !owners[segment].objects.empty()) {
      label = settled(label, owners[segment]);
    }
    if (is_object(label)) {
      ++pixel_counts[label];
    }
  }
  for (ObjectObservation& object : segmentation.objects) {
    object.pixel_count = pixel_counts[object.label];
  }
  return segmentation;
}

}  // namespace credo
