#include "stages/planes/segment_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace credo {
namespace {

/// At most so many points are searched, for at most so many planes. A prime, so that they keep step
/// with no pattern.
constexpr std::size_t kMostPoints = 509;
constexpr int kMostPlanes = 3;
/// Of the pixels that a plane must have, those of one segment: a wall may be seen in pieces.
constexpr double kLeastPart = 0.25;

/// The positions of points in their sample, segment after segment.
class PositionsBySegment {
public:
  PositionsBySegment(Segments const& segments, PlaneSearchPoints const& sample)
      : ends_(segments.pixel_counts.size() + 2, 0), positions_(sample.size()) {
    auto const segment_of = [&](std::size_t i) {
      return static_cast<std::size_t>(segments.labels[sample.source[i]]);
    };
    for (std::size_t i = 0; i < sample.size(); ++i) {
      ++ends_[segment_of(i) + 1];
    }
    for (std::size_t k = 1; k < ends_.size(); ++k) {
      ends_[k] += ends_[k - 1];
    }
    // What is each segment's begin now is its end once its points are in.
    for (std::size_t i = 0; i < sample.size(); ++i) {
      positions_[ends_[segment_of(i)]++] = static_cast<std::uint32_t>(i);
    }
  }

  [[nodiscard]] std::span<std::uint32_t const> of(std::size_t segment) const {
    std::size_t const begin = ends_[segment - 1];
    return std::span(positions_).subspan(begin, ends_[segment] - begin);
  }

private:
  std::vector<std::size_t> ends_;
  std::vector<std::uint32_t> positions_;
};

PlaneSearchPoints spread_points(PlaneSearchPoints const& sample,
                                std::span<std::uint32_t const> positions) {
  std::vector<std::uint32_t> some(std::min(kMostPoints, positions.size()));
  for (std::size_t k = 0; k < some.size(); ++k) {
    some[k] = positions[k * positions.size() / some.size()];
  }
  return sample.at(some);
}

/// Appends those planes of the points at `positions` that are upright, or else those that are
/// level; what has fewer than `least` of the points is none.
void search(PlaneView const& view, PlaneSearchPoints const& sample,
            std::span<std::uint32_t const> positions, double least, bool upright,
            std::uint32_t seed, std::vector<Plane>& planes) {
  if (static_cast<double>(positions.size()) < least) {
    return;
  }
  PlanesConfig const& config = view.config;
  PlaneSearchPoints points = spread_points(sample, positions);
  double const least_spread =
      least * static_cast<double>(points.size()) / static_cast<double>(positions.size());
  for (int k = 0; k < kMostPlanes && static_cast<double>(points.size()) >= least_spread; ++k) {
    std::optional<FoundPlane> const found =
        find_largest_plane(points, {config.sampling, config.max_angle_rad, config.confidence,
                                    config.max_hypotheses, config.scoring_points, seed});
    if (!found || static_cast<double>(found->inlier_count) < least_spread) {
      return;
    }
    double const normal_z = std::abs((view.T_world_camera.rotation() * found->plane.normal).z());
    if (upright ? normal_z < config.wall_max_normal_z
                : normal_z >= 1.0 - config.floor_max_normal_z_gap) {
      planes.push_back(found->plane);
    }
    points.remove(found->inliers);
  }
}

/// The positions of points that are near enough to z = 0 to be floor.
std::vector<std::uint32_t> low_positions(PlaneView const& view, PlaneSearchPoints const& sample) {
  Heights const height_m(view);
  auto const most_m = static_cast<float>(
      std::max(view.config.floor_max_height_m, view.config.floor_max_mean_height_m));
  std::vector<std::uint32_t> low;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (std::abs(height_m(sample.source[i])) <= most_m) {
      low.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return low;
}

/// Those with at least so many points of the sample, the one with the most first, and of equals the
/// one that was first.
std::vector<Plane> largest_first(std::vector<Plane> const& planes, PlaneSearchPoints const& sample,
                                 double least, double max_angle_rad) {
  struct Sized {
    Plane plane;
    std::size_t points;
  };
  std::vector<Sized> sized;
  sized.reserve(planes.size());
  for (Plane const& plane : planes) {
    std::size_t const points = inliers_of(plane, sample, max_angle_rad).inlier_count;
    if (static_cast<double>(points) >= least) {
      sized.push_back({plane, points});
    }
  }
  std::ranges::stable_sort(sized, std::ranges::greater(), &Sized::points);
  std::vector<Plane> sorted;
  sorted.reserve(planes.size());
  std::ranges::transform(sized, std::back_inserter(sorted), &Sized::plane);
  return sorted;
}

}  // namespace

std::vector<Plane> segment_planes(PlaneView const& view, Segments const& segments,
                                  PlaneSearchPoints const& sample, double pixels_per_point) {
  double const least = view.config.min_plane_pixels / pixels_per_point;
  auto seed = static_cast<std::uint32_t>(view.config.seed);
  std::vector<Plane> planes;
  if (view.floor_at_zero) {
    search(view, sample, low_positions(view, sample), least, false, seed, planes);
  }
  PositionsBySegment const positions(segments, sample);
  for (std::size_t segment = 1; segment <= segments.pixel_counts.size(); ++segment) {
    search(view, sample, positions.of(segment), kLeastPart * least, true, ++seed, planes);
  }
  return largest_first(planes, sample, least, view.config.max_angle_rad);
}

}  // namespace credo
