#include "stages/planes/remaining_points.hpp"

#include <algorithm>
#include <utility>

#include "geometry/segment_shares.hpp"

namespace credo {
namespace {

/// So many tolerances from the plane is near enough for what is on its segment anyway.
constexpr float kNear = 3.0F;

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
  std::vector<std::uint32_t> const held = held_by(plane);
  auto const share = [&](std::size_t i) {
    std::size_t const segment = segment_of(i);
    return segment == 0
               ? 0.5
               : static_cast<double>(held[segment]) / static_cast<double>(eligible_[segment]);
  };
  CountedPixels back{PixelSet(view_.cloud.size()), 0};
  plane.inliers.pixels.for_each([&](std::size_t i) {
    if (share(i) <= kHardlyShare) {
      back.insert(i);
    }
  });
  CountedPixels near{PixelSet(view_.cloud.size()), 0};
  pixels_.pixels.for_each([&](std::size_t i) {
    if (share(i) >= kMostlyShare) {
      near.insert(i);
    }
  });
  PlaneTolerance const wide{kNear * view_.tolerance.fixed_m, kNear * view_.tolerance.noise_sigmas,
                            0.0F};
  near = plane_inliers(plane.camera, view_.cloud, view_.normals, near.pixels, wide);
  pixels_.remove(near);
  plane.inliers.remove(back);
  near.pixels.for_each([&](std::size_t i) { plane.inliers.insert(i); });
  back.pixels.for_each([&](std::size_t i) { pixels_.insert(i); });
  plane.inliers.pixels.for_each([&](std::size_t i) { --eligible_[segment_of(i)]; });
}

/// Of each segment, how many pixels a plane has.
std::vector<std::uint32_t> RemainingPoints::held_by(PixelPlane const& plane) const {
  std::vector<std::uint32_t> held(eligible_.size(), 0);
  plane.inliers.pixels.for_each([&](std::size_t i) { ++held[segment_of(i)]; });
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
  return {up ? camera : camera.flipped(), up ? world : world.flipped(), std::move(inliers)};
}

}  // namespace credo
