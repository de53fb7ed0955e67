#include "stages/planes/holes.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "geometry/segment_shares.hpp"
#include "stages/planes/is_floor.hpp"
#include "stages/planes/labelled_pixels.hpp"

namespace credo {
namespace {

/// Of some pixels, those in segments that nothing has, or that these are most of; of all without
/// segments.
CountedPixels whole_segments(CountedPixels pixels, CountedPixels const& unassigned,
                             Segments const& segments) {
  if (segments.labels.empty()) {
    return pixels;
  }
  auto const segment_of = [&](std::size_t i) {
    return static_cast<std::size_t>(segments.labels[i]);
  };
  std::vector<std::uint32_t> all(segments.pixel_counts.size() + 1, 0);
  std::vector<std::uint32_t> some(all.size(), 0);
  unassigned.pixels.for_each([&](std::size_t i) { ++all[segment_of(i)]; });
  pixels.pixels.for_each([&](std::size_t i) { ++some[segment_of(i)]; });
  CountedPixels others{PixelSet(segments.labels.size()), 0};
  pixels.pixels.for_each([&](std::size_t i) {
    std::size_t const segment = segment_of(i);
    if (segment != 0 && some[segment] < kMostlyShare * all[segment]) {
      others.insert(i);
    }
  });
  pixels.remove(others);
  return pixels;
}

}  // namespace

void fill_holes(PlaneView const& view, std::vector<FoundSurface> const& found,
                Segmentation& segmentation) {
  constexpr float kAllBut = 0.5F;
  PlaneTolerance const close{kAllBut * view.tolerance.fixed_m,
                             kAllBut * view.tolerance.noise_sigmas, 0.0F};
  CountedPixels unassigned = unassigned_pixels(segmentation.labels);
  for (auto const& [label, plane_camera] : found) {
    CountedPixels joining =
        plane_inliers(plane_camera, view.cloud, view.normals, unassigned.pixels, close);
    joining = whole_segments(std::move(joining), unassigned, segmentation.segments);
    if (label == kFloor) {
      joining = low_pixels(view, std::move(joining));
    }
    joining.pixels.for_each([&, code = label](std::size_t i) { segmentation.labels[i] = code; });
    unassigned.remove(joining);
  }
}

}  // namespace credo
