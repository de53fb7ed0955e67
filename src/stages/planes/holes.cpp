#include "stages/planes/holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/runs.hpp"
#include "geometry/segment_shares.hpp"
#include "stages/planes/is_floor.hpp"
#include "stages/planes/labelled_pixels.hpp"

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

/// What floor and walls have of the segments.
struct SegmentsHeld {
  Grid<std::int32_t> const* labels;
  std::size_t surfaces;
  /// Of each segment: pixels without known objects', and those that any surface has.
  std::vector<std::uint32_t> all, explained;
  /// Of each segment, surface after surface: pixels that it has.
  std::vector<std::uint32_t> held;

  [[nodiscard]] std::size_t segment_of(std::size_t pixel) const {
    return static_cast<std::size_t>((*labels)[pixel]);
  }
  [[nodiscard]] bool mostly(std::size_t segment) const {
    return segment != 0 && explained[segment] >= kMostlyShare * all[segment];
  }
  [[nodiscard]] bool hardly(std::size_t segment, std::size_t surface) const {
    return held[segment * surfaces + surface] <= kHardlyShare * all[segment];
  }
};

SegmentsHeld segments_held(Segmentation const& segmentation,
                           std::vector<FoundSurface> const& found) {
  SegmentsHeld result{&segmentation.segments.labels, found.size(), {}, {}, {}};
  result.all.assign(segmentation.segments.pixel_counts.size() + 1, 0);
  result.explained.assign(result.all.size(), 0);
  result.held.assign(result.all.size() * found.size(), 0);
  // A later plane may be more of the same floor: one counts for both.
  std::vector<std::size_t> surface_of(kFirstObject, found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    surface_of[found[k].label] = k;
  }
  for_each_run(std::span<LabelCode const>(segmentation.labels),
               std::span<std::int32_t const>(segmentation.segments.labels),
               [&](std::size_t begin, std::size_t end) {
                 LabelCode const label = segmentation.labels[begin];
                 if (label == kNoDepth || label >= kFirstObject) {
                   return;
                 }
                 auto const pixels = static_cast<std::uint32_t>(end - begin);
                 std::size_t const segment = result.segment_of(begin);
                 result.all[segment] += pixels;
                 if (surface_of[label] < found.size()) {
                   result.explained[segment] += pixels;
                   result.held[segment * found.size() + surface_of[label]] += pixels;
                 }
               });
  return result;
}

/// Of the segments that floor and walls hold most of, the rest to the nearest; takes it out of what
/// is unassigned.
void complete_segments(PlaneView const& view, std::vector<FoundSurface> const& found,
                       CountedPixels& unassigned, Segmentation& segmentation) {
  if (found.empty() || segmentation.segments.labels.empty()) {
    return;
  }
  SegmentsHeld const held = segments_held(segmentation, found);
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
    near_to[k].pixels.for_each([&](std::size_t i) {
      if (!taken.pixels.contains(i)) {
        taken.insert(i);
        segmentation.labels[i] = found[k].label;
        return;
      }
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
  for (auto const& [label, plane_camera] : found) {
    CountedPixels joining = inliers_among(view, plane_camera, unassigned.pixels, close);
    joining = whole_segments(std::move(joining), unassigned, view.pieces);
    if (label == kFloor) {
      joining = low_pixels(view, std::move(joining));
    }
    joining.pixels.for_each([&, code = label](std::size_t i) { segmentation.labels[i] = code; });
    unassigned.remove(joining);
  }
}

}  // namespace

void fill_holes(PlaneView const& view, std::vector<FoundSurface> const& found,
                Segmentation& segmentation) {
  CountedPixels unassigned =
      unassigned_pixels(segmentation.labels, segmentation.segments, view.pieces);
  complete_segments(view, found, unassigned, segmentation);
  complete_planes(view, found, std::move(unassigned), segmentation);
}

}  // namespace credo
