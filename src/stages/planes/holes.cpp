#include "stages/planes/holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/segment_shares.hpp"
#include "stages/planes/is_floor.hpp"

namespace credo {
namespace {

/// Of some pixels, those in segments that nothing has, or that these are most of; of all without
/// segments.
CountedPixels whole_segments(CountedPixels pixels, CountedPixels const& unassigned,
                             SegmentPieces const& pieces) {
  if (pieces.empty()) {
    return pixels;
  }
  std::vector<std::uint32_t> const all = pieces.counts(unassigned.pixels);
  std::vector<std::uint32_t> const some = pieces.counts(pixels.pixels);
  return pieces.where(pixels.pixels, [&](std::size_t segment) {
    return segment == 0 || some[segment] >= kMostlyShare * all[segment];
  });
}

void set_label(CountedPixels const& pixels, LabelCode label, LabelMap& labels) {
  pixels.pixels.for_each_run([&](std::size_t begin, std::size_t end) {
    std::fill(labels.data() + begin, labels.data() + end, label);
  });
}

/// What floor and walls have of the segments.
class SegmentsHeld {
public:
  SegmentsHeld(SegmentPieces const& pieces, std::vector<FoundSurface> const& found,
               CountedPixels const& free)
      : free_(pieces.counts(free.pixels)), explained_(free_.size(), 0) {
    // A later plane may be more of the same floor: one counts for both.
    std::vector<std::size_t> last(kFirstObject, 0);
    for (std::size_t k = 0; k < found.size(); ++k) {
      last[found[k].label] = k;
    }
    held_.assign(found.size(), std::vector<std::uint32_t>(free_.size(), 0));
    for (FoundSurface const& surface : found) {
      std::vector<std::uint32_t> const counts = pieces.counts(surface.pixels.pixels);
      for (auto* const sums : {&explained_, &held_[last[surface.label]]}) {
        std::ranges::transform(*sums, counts, sums->begin(), std::plus());
      }
    }
  }

  [[nodiscard]] bool mostly(std::size_t segment) const {
    return segment != 0 && explained_[segment] >= kMostlyShare * free_[segment];
  }
  [[nodiscard]] bool hardly(std::size_t segment, std::size_t surface) const {
    return held_[surface][segment] <= kHardlyShare * free_[segment];
  }

private:
  /// Of each segment: pixels that floor and walls could have, and those that any of them has.
  std::vector<std::uint32_t> free_, explained_;
  /// Of each surface, by segment.
  std::vector<std::vector<std::uint32_t>> held_;
};

/// Of the segments that floor and walls hold most of, the rest to the nearest; takes it out of what
/// is unassigned.
void complete_segments(PlaneView const& view, std::vector<FoundSurface> const& found,
                       SegmentsHeld const& held, CountedPixels& unassigned,
                       Segmentation& segmentation) {
  PlaneTolerance const near = near_tolerance(view.tolerance, 0.0F);
  CountedPixels const open = view.pieces.where(
      unassigned.pixels, [&](std::size_t segment) { return held.mostly(segment); });
  // Most pixels are near to one surface alone.
  std::vector<CountedPixels> near_to;
  CountedPixels taken{PixelSet(view.cloud.size()), 0};
  for (std::size_t k = 0; k < found.size(); ++k) {
    CountedPixels const asked = view.pieces.where(
        open.pixels, [&](std::size_t segment) { return !held.hardly(segment, k); });
    near_to.push_back(inliers_among(view, found[k].camera, asked.pixels, near));
    if (found[k].label == kFloor) {
      near_to[k] = low_pixels(view, std::move(near_to[k]));
    }
    CountedPixels first = near_to[k];
    CountedPixels contested = first.common(taken.pixels);
    first.remove(contested);
    set_label(first, found[k].label, segmentation.labels);
    taken.insert(first);
    contested.pixels.for_each([&](std::size_t i) {
      Eigen::Vector3d const p_camera = view.cloud.at(i).cast<double>();
      auto const distance_m = [&](std::size_t surface) {
        return std::abs(found[surface].camera.signed_distance_m(p_camera));
      };
      bool is_nearest = true;
      for (std::size_t other = 0; other < k; ++other) {
        is_nearest = is_nearest &&
                     (!near_to[other].pixels.contains(i) || distance_m(k) <= distance_m(other));
      }
      if (is_nearest) {
        segmentation.labels[i] = found[k].label;
      }
    });
  }
  unassigned.remove(taken);
}

/// Pixels that all but lie in a plane to the first such.
void complete_planes(PlaneView const& view, std::vector<FoundSurface> const& found,
                     CountedPixels unassigned, Segmentation& segmentation) {
  constexpr float kAllBut = 0.5F;
  PlaneTolerance const close{kAllBut * view.tolerance.fixed_m,
                             kAllBut * view.tolerance.noise_sigmas, 0.0F};
  for (FoundSurface const& surface : found) {
    PixelSet const asked = unassigned.common(surface.open).pixels;
    CountedPixels joining = inliers_among(view, surface.camera, asked, close);
    joining = whole_segments(std::move(joining), unassigned, view.pieces);
    if (surface.label == kFloor) {
      joining = low_pixels(view, std::move(joining));
    }
    set_label(joining, surface.label, segmentation.labels);
    unassigned.remove(joining);
  }
}

}  // namespace

void fill_holes(PlaneView const& view, std::vector<FoundSurface> const& found, CountedPixels free,
                Segmentation& segmentation) {
  SegmentsHeld const held(view.pieces, found, free);
  for (FoundSurface const& surface : found) {
    free.remove(surface.pixels);
  }
  if (!view.pieces.empty()) {
    complete_segments(view, found, held, free, segmentation);
  }
  complete_planes(view, found, std::move(free), segmentation);
}

}  // namespace credo
