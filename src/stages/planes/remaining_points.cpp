#include "stages/planes/remaining_points.hpp"

#include <algorithm>
#include <utility>

#include "geometry/segment_shares.hpp"

namespace credo {
namespace {

/// 60 degrees: more than noise turns most normals by, less than the next wall is turned.
constexpr float kLooseCosine = 0.5F;

}  // namespace

RemainingPoints::RemainingPoints(PlaneView const& view, Segments const& segments,
                                 CountedPixels pixels)
    : view_(view), segments_(segments), pixels_(std::move(pixels)) {
  if (!segments.labels.empty()) {
    eligible_.assign(segments.pixel_counts.size() + 1, 0);
    pixels_.pixels.for_each([&](std::size_t i) { ++eligible_[segment_of(i)]; });
  }
}

std::optional<PixelPlane> RemainingPoints::take_largest(std::uint32_t seed) {
  PlanesConfig const& config = view_.config;
  auto const least = static_cast<std::size_t>(config.min_plane_pixels);
  if (pixels_.count < least) {
    return std::nullopt;
  }
  refresh_sample();
  std::optional<FoundPlane> const found =
      find_largest_plane(sample_, {config.sampling, config.max_angle_rad, config.confidence,
                                   config.max_hypotheses, config.scoring_points, seed});
  if (!found) {
    return std::nullopt;
  }
  CountedPixels inliers =
      plane_inliers(found->plane, view_.cloud, view_.normals, pixels_.pixels, view_.tolerance);
  if (inliers.count < least) {
    return std::nullopt;
  }
  pixels_.remove(inliers);
  sample_.remove(found->inliers);
  return oriented(found->plane, std::move(inliers));
}

void RemainingPoints::settle(PixelPlane& plane) {
  if (eligible_.empty()) {
    return;
  }
  std::vector<Held> const held = held_of_segments(plane);
  CountedPixels back{PixelSet(view_.cloud.size()), 0};
  plane.inliers.pixels.for_each([&](std::size_t i) {
    if (held[segment_of(i)] == Held::kHardly) {
      back.insert(i);
    }
  });
  CountedPixels around{PixelSet(view_.cloud.size()), 0};
  pixels_.pixels.for_each([&](std::size_t i) {
    if (held[segment_of(i)] == Held::kMostly) {
      around.insert(i);
    }
  });
  // Not what faces elsewhere: the next wall, where no crease parts it from this one.
  plane.joined = plane_inliers(plane.camera, view_.cloud, view_.normals, around.pixels,
                               near_tolerance(view_.tolerance, kLooseCosine));
  pixels_.remove(plane.joined);
  plane.inliers.remove(back);
  back.pixels.for_each([&](std::size_t i) { pixels_.insert(i); });
  auto const take = [&](std::size_t i) { --eligible_[segment_of(i)]; };
  plane.inliers.pixels.for_each(take);
  plane.joined.pixels.for_each(take);
}

std::vector<RemainingPoints::Held> RemainingPoints::held_of_segments(
    PixelPlane const& plane) const {
  PlaneTolerance const by_distance{view_.tolerance.fixed_m, view_.tolerance.noise_sigmas, 0.0F};
  CountedPixels const in_plane =
      plane_inliers(plane.camera, view_.cloud, view_.normals, pixels_.pixels, by_distance);
  std::vector<std::uint32_t> inliers(eligible_.size(), 0);
  std::vector<std::uint32_t> turned(eligible_.size(), 0);
  plane.inliers.pixels.for_each([&](std::size_t i) { ++inliers[segment_of(i)]; });
  in_plane.pixels.for_each([&](std::size_t i) { ++turned[segment_of(i)]; });
  std::vector<Held> held(eligible_.size(), Held::kPartly);
  for (std::size_t k = 1; k < held.size(); ++k) {
    if (inliers[k] <= kHardlyShare * eligible_[k]) {
      held[k] = Held::kHardly;
    } else if (inliers[k] + turned[k] >= kMostlyShare * eligible_[k]) {
      held[k] = Held::kMostly;
    }
  }
  return held;
}

/// Planes thin the sample out: once half of it has gone, what remains is sampled anew.
void RemainingPoints::refresh_sample() {
  auto const most = static_cast<std::size_t>(view_.config.sample_points);
  if (2 * sample_.size() >= std::min(most, pixels_.count)) {
    return;
  }
  sample_ = {};
  sample_.reserve(std::min(pixels_.count, most));
  pixels_.pixels.for_every((pixels_.count + most - 1) / most, [&](std::size_t i) {
    sample_.add(view_.cloud.at(i), view_.normals.at(i),
                view_.tolerance.distance_m(view_.cloud.z[i]), static_cast<std::uint32_t>(i));
  });
}

/// With the normal up.
PixelPlane RemainingPoints::oriented(Plane const& camera, CountedPixels inliers) const {
  Plane const world = transformed(view_.T_world_camera, camera);
  bool const up = world.normal.z() >= 0.0;
  return PixelPlane{.camera = up ? camera : camera.flipped(),
                    .world = up ? world : world.flipped(),
                    .inliers = std::move(inliers)};
}

}  // namespace credo
