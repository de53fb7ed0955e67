#include "stages/segments/settling.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "geometry/label_bits.hpp"
#include "geometry/segment_shares.hpp"

namespace credo {
namespace {

/// Of a segment, what objects must hold for the rest to be the largest's. Less than floor and walls
/// must (kMostlyShare): a pose that is some centimetres off reaches but a strip of what it is a
/// pose of, and nothing says of another thing that it is there.
constexpr double kObjectsShare = 0.3;

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
  [[nodiscard]] double share() const {
    return static_cast<double>(held_px()) / static_cast<double>(pixels);
  }
  /// Of equals the lower label.
  [[nodiscard]] LabelCode largest() const {
    return std::ranges::max_element(objects, {}, [](auto const& one) { return one.second; })->first;
  }
};

/// Calls `visit(segment, begin, end)` for pixels side by side that have one label and are of one
/// segment.
template <typename Visit>
void for_each_piece(Segmentation const& segmentation, Visit const& visit) {
  std::span<std::int32_t const> const segments(segmentation.segments.labels);
  for_each_run(segmentation.labels, segments, [&](std::size_t begin, std::size_t end) {
    visit(static_cast<std::size_t>(segments[begin]), begin, end);
  });
}

std::vector<Owners> owners_of(Segmentation const& segmentation) {
  std::vector<Owners> owners(segmentation.segments.pixel_counts.size() + 1);
  for_each_piece(segmentation, [&](std::size_t segment, std::size_t begin, std::size_t end) {
    auto const pixels = static_cast<std::uint32_t>(end - begin);
    LabelCode const label = segmentation.labels[begin];
    owners[segment].pixels += pixels;
    if (is_object(label)) {
      owners[segment].objects[label] += pixels;
    }
  });
  return owners;
}

/// A thing that lies on a surface of an object is in the reach of that object's pose, but is none
/// of it.
bool is_anothers(std::size_t segment, std::vector<Owners> const& owners, Segments const& segments) {
  auto const base =
      static_cast<std::size_t>(segments.lies_on.empty() ? 0 : segments.lies_on[segment - 1]);
  return base != 0 && owners[base].share() >= kObjectsShare &&
         owners[base].largest() == owners[segment].largest();
}

/// What becomes of a pixel of a segment.
LabelCode settled(LabelCode label, Owners const& owner) {
  if (label == kUnassigned && owner.share() >= kObjectsShare) {
    return owner.largest();
  }
  return is_object(label) && owner.share() <= kHardlyShare ? kUnassigned : label;
}

}  // namespace

Segmentation settle_objects(Segmentation segmentation) {
  if (segmentation.segments.labels.empty() || segmentation.objects.empty()) {
    return segmentation;
  }
  std::vector<Owners> const owners = owners_of(segmentation);
  std::map<LabelCode, std::size_t> pixel_counts;
  for_each_piece(segmentation, [&](std::size_t segment, std::size_t begin, std::size_t end) {
    LabelCode label = segmentation.labels[begin];
    // Segment 0 is what belongs to none.
    if (segment > 0 && !owners[segment].objects.empty()) {
      if (!is_anothers(segment, owners, segmentation.segments)) {
        label = settled(label, owners[segment]);
      } else if (is_object(label)) {
        label = kUnassigned;
      }
      std::fill(segmentation.labels.data() + begin, segmentation.labels.data() + end, label);
    }
    if (is_object(label)) {
      pixel_counts[label] += end - begin;
    }
  });
  for (ObjectObservation& object : segmentation.objects) {
    object.pixel_count = pixel_counts[object.label];
  }
  return segmentation;
}

}  // namespace credo
