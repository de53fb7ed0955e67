#include "stages/planes/remaining_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "geometry/segment_shares.hpp"
#include "stages/planes/is_wall.hpp"
#include "stages/planes/plane_sample.hpp"
#include "stages/planes/segment_planes.hpp"

namespace credo {
namespace {

/// 60 degrees: more than noise turns most normals by, less than the next wall is turned.
constexpr float kLooseCosine = 0.5F;
/// Points of a segment in the same plane lie on both of its sides: their mean distance from it is
/// within this part of their tolerance.
constexpr double kMostBias = 0.25;

}  // namespace

RemainingPoints::RemainingPoints(PlaneView const& view, Segments const& segments,
                                 CountedPixels pixels)
    : view_(view),
      segments_(segments),
      all_(pixels.pixels),
      pixels_(std::move(pixels)),
      eligible_(view.pieces.counts(pixels_.pixels)) {}

std::optional<PixelPlane> RemainingPoints::take_largest(std::uint32_t seed) {
  PlanesConfig const& config = view_.config;
  if (pixels_.count < static_cast<std::size_t>(config.min_plane_pixels)) {
    return std::nullopt;
  }
  refresh_sample();
  std::optional<FoundPlane> const found =
      find_largest_plane(sample_, {config.sampling, config.max_angle_rad, config.confidence,
                                   config.max_hypotheses, config.scoring_points, seed});
  if (!found) {
    return std::nullopt;
  }
  return take_found(*found);
}

std::vector<Plane> RemainingPoints::suggested() {
  refresh_sample();
  whole_sample_ = sample_;
  return segment_planes(view_, segments_, sample_, pixels_per_point_);
}

std::optional<PixelPlane> RemainingPoints::take(Plane const& suggested) {
  double const angle_rad = view_.config.max_angle_rad;
  bool const upright = is_upright(suggested);
  int const least = upright ? view_.config.wall_min_pixels : view_.config.min_plane_pixels;
  FoundPlane found = inliers_of(suggested, sample_, angle_rad);
  if (static_cast<double>(found.inlier_count) * pixels_per_point_ < least) {
    return std::nullopt;
  }
  found = upright ? fitted_to_segments(std::move(found))
                  : refined(std::move(found), sample_, angle_rad);
  if (upright && !may_be_wall(found)) {
    // Most upright planes are none: their pixels are not even looked at.
    sample_.remove(found.inliers);
    return std::nullopt;
  }
  return take_found(found);
}

bool RemainingPoints::may_be_wall(FoundPlane const& found) const {
  std::vector<std::uint32_t> shown;
  shown.reserve(found.inlier_count);
  for (std::size_t i = 0; i < sample_.size(); ++i) {
    if (found.inliers[i] != 0) {
      shown.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return credo::may_be_wall(view_, oriented(found.plane, {{PixelSet(0), 0}}), std::move(shown),
                            sample_, whole_sample_, pixels_per_point_);
}

std::optional<PixelPlane> RemainingPoints::take_found(FoundPlane const& found) {
  PlanePixels pixels = plane_pixels_among(view_, found.plane, pixels_.pixels);
  if (pixels.inliers.count < static_cast<std::size_t>(view_.config.min_plane_pixels)) {
    return std::nullopt;
  }
  pixels_.remove(pixels.inliers);
  sample_.remove(found.inliers);
  return oriented(found.plane, std::move(pixels));
}

bool RemainingPoints::is_upright(Plane const& plane_camera) const {
  Eigen::Vector3d const normal_world = view_.T_world_camera.rotation() * plane_camera.normal;
  return std::abs(normal_world.z()) < view_.config.wall_max_normal_z;
}

FoundPlane RemainingPoints::fitted_to_segments(FoundPlane found) const {
  std::vector<std::uint32_t> inliers(eligible_.size(), 0);
  for (std::size_t i = 0; i < sample_.size(); ++i) {
    inliers[segment_of(sample_.source[i])] += found.inliers[i];
  }
  auto const largest = static_cast<std::size_t>(
      std::max_element(inliers.begin() + 1, inliers.end()) - inliers.begin());
  std::optional<Plane> const of_largest =
      fit_plane(sample_, flags_where([&](std::size_t i, std::size_t segment) {
                  return found.inliers[i] != 0 && segment == largest;
                }),
                found.plane.normal);
  if (!of_largest) {
    return found;
  }
  double const angle_rad = view_.config.max_angle_rad;
  std::vector<std::uint8_t> const near = inliers_of(*of_largest, sample_, angle_rad).inliers;
  std::vector<double> const bias = mean_distances(*of_largest, near);
  std::optional<Plane> const of_coplanar =
      fit_plane(sample_, flags_where([&](std::size_t i, std::size_t segment) {
                  return near[i] != 0 && segment != 0 && std::abs(bias[segment]) <= kMostBias;
                }),
                found.plane.normal);
  return of_coplanar ? inliers_of(*of_coplanar, sample_, angle_rad) : found;
}

std::vector<double> RemainingPoints::mean_distances(Plane const& plane,
                                                    std::vector<std::uint8_t> const& flags) const {
  std::vector<double> sums(eligible_.size(), 0.0);
  std::vector<std::uint32_t> counts(eligible_.size(), 0);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i] != 0) {
      Eigen::Vector3d const p(sample_.x[i], sample_.y[i], sample_.z[i]);
      std::size_t const segment = segment_of(sample_.source[i]);
      sums[segment] += plane.signed_distance_m(p) / static_cast<double>(sample_.tolerance_m[i]);
      ++counts[segment];
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k] /= std::max<std::uint32_t>(1, counts[k]);
  }
  return sums;
}

void RemainingPoints::settle(PixelPlane& plane) {
  plane.open = all_;
  plane.open.remove(pixels_.pixels);
  plane.open.remove(plane.inliers.pixels);
  if (eligible_.empty()) {
    return;
  }
  std::vector<Held> const held = held_of_segments(plane);
  CountedPixels const back = view_.pieces.where(
      plane.inliers.pixels, [&](std::size_t segment) { return held[segment] == Held::kHardly; });
  CountedPixels const around = view_.pieces.where(
      pixels_.pixels, [&](std::size_t segment) { return held[segment] == Held::kMostly; });
  // Not what faces elsewhere: the next wall, where no crease parts it from this one.
  plane.joined = inliers_among(view_, plane.camera, around.pixels,
                               near_tolerance(view_.tolerance, kLooseCosine));
  pixels_.remove(plane.joined);
  plane.inliers.remove(back);
  plane.open.insert(back.pixels);
  pixels_.insert(back);
  for (CountedPixels const& taken : {std::cref(plane.inliers), std::cref(plane.joined)}) {
    std::ranges::transform(eligible_, view_.pieces.counts(taken.pixels), eligible_.begin(),
                           std::minus());
  }
}

std::vector<RemainingPoints::Held> RemainingPoints::held_of_segments(
    PixelPlane const& plane) const {
  std::vector<std::uint32_t> const inliers = view_.pieces.counts(plane.inliers.pixels);
  std::vector<std::uint32_t> const turned = view_.pieces.counts(plane.turned);
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
  sample_ = sample_of(pixels_, most, view_.cloud, view_.normals, view_.tolerance);
  pixels_per_point_ = static_cast<double>(pixels_.count) / static_cast<double>(sample_.size());
}

/// With the normal up.
PixelPlane RemainingPoints::oriented(Plane const& camera, PlanePixels pixels) const {
  Plane const world = transformed(view_.T_world_camera, camera);
  bool const up = world.normal.z() >= 0.0;
  return PixelPlane{.camera = up ? camera : camera.flipped(),
                    .world = up ? world : world.flipped(),
                    .inliers = std::move(pixels.inliers),
                    .turned = std::move(pixels.turned)};
}

}  // namespace credo
