#include "stages/capture/floor_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace credo {
namespace {

constexpr int kMaxPlanes = 12;         // largest first; a floor is not among the crumbs
constexpr double kMinShare = 0.02;     // of the valid points
constexpr double kMaxTiltRad = 1.134;  // 65 degrees: how far a camera may be pitched and rolled
constexpr double kMinHeightM = 0.2;    // a camera does not lie on the floor
constexpr double kMaxShareBeneath = 0.02;

/// Share of all points clear of the plane on its lower side, relative to the plane's own.
double share_beneath(Plane const& plane, PlaneSearchPoints const& all, std::size_t own) {
  std::size_t beneath = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    double const height_m = plane.signed_distance_m(Eigen::Vector3d(all.x[i], all.y[i], all.z[i]));
    beneath += height_m < -(0.03 + 3.0 * static_cast<double>(all.tolerance_m[i])) ? 1U : 0U;
  }
  return static_cast<double>(beneath) / static_cast<double>(std::max<std::size_t>(own, 1));
}

struct Outline {
  std::size_t held = 0;  // something stands on the plane there, or hides it
  std::size_t free = 0;  // a drop, or a wide stretch without depth at a range where there is depth
};

/// Walks outwards from the plane's cells in the four directions and sees what comes next.
class OutlineWalk {
public:
  OutlineWalk(CoarseCloud const& coarse, Plane const& plane, std::vector<std::uint8_t> const& flags)
      : points_(coarse.points),
        plane_(plane),
        member_(points_.width(), points_.height(), 0),
        // A depth camera leaves a margin without depth, and a shadow beside near things.
        gap_cells_(std::max(2, points_.width() * 9 / 100)) {
    for (std::size_t k = 0; k < flags.size(); ++k) {
      member_[coarse.search.source[k]] = flags[k];
    }
  }

  Outline operator()() const {
    Outline outline;
    for (std::size_t i = 0; i < member_.size(); ++i) {
      if (member_[i] != 0) {
        for (Pixel const step : {Pixel{1, 0}, Pixel{-1, 0}, Pixel{0, 1}, Pixel{0, -1}}) {
          look(member_.pixel(i), step, outline);
        }
      }
    }
    return outline;
  }

private:
  void look(Pixel cell, Pixel step, Outline& outline) const {
    float const depth_m = points_[cell].z();
    for (int gap = 0;; ++gap) {
      cell = {cell.u + step.u, cell.v + step.v};
      if (!points_.contains(cell)) {
        return;  // the picture ends within the margin
      }
      if (gap > gap_cells_) {
        // Beyond about 2.5 m a grazing or dark floor may simply not return.
        outline.free += depth_m < 2.5F ? 1 : 0;
        return;
      }
      if (points_[cell].hasNaN()) {
        continue;
      }
      if (member_[cell] != 0) {
        return;
      }
      double const height_m = plane_.signed_distance_m(points_[cell].cast<double>());
      double const clear_m = 0.01 + 2.0 * noise_tolerance_m(points_[cell].z());
      outline.held += height_m > clear_m ? 1 : 0;
      outline.free += height_m < -clear_m ? 1 : 0;
      return;
    }
  }

  Grid<Eigen::Vector3f> const& points_;
  Plane plane_;
  Grid<std::uint8_t> member_;
  int gap_cells_;
};

bool could_be_floor(Plane const& plane) {
  double const up = plane.normal.dot(-Eigen::Vector3d::UnitY());
  double const camera_height_m = plane.signed_distance_m(Eigen::Vector3d::Zero());
  return up > std::cos(kMaxTiltRad) && camera_height_m > kMinHeightM;
}

}  // namespace

std::optional<Plane> find_floor(OrganizedCloud const& cloud) {
  return find_floor(coarse_cloud(cloud));
}

std::optional<Plane> find_floor(CoarseCloud const& coarse) {
  PlaneSearchPoints remaining = coarse.search;
  PlaneSearchLimits limits{PlaneSampling::kPointAndNormal, 0.35, 0.9999, 400, 2048, 1};
  auto const least =
      static_cast<std::size_t>(kMinShare * static_cast<double>(coarse.search.size()));
  for (int k = 0; k < kMaxPlanes; ++k) {
    std::optional<FoundPlane> found = find_largest_plane(remaining, limits);
    if (!found || found->inlier_count < std::max<std::size_t>(least, 50)) {
      break;
    }
    Plane const plane = found->plane.normal.y() > 0 ? found->plane.flipped() : found->plane;
    if (could_be_floor(plane)) {
      FoundPlane const whole = inliers_of(plane, coarse.search, limits.max_angle_rad);
      Outline const outline = OutlineWalk(coarse, plane, whole.inliers)();
      double const beneath = share_beneath(plane, coarse.search, whole.inlier_count);
      if (beneath <= kMaxShareBeneath && outline.free <= outline.held) {
        return plane;
      }
    }
    remaining.remove(found->inliers);
  }
  return std::nullopt;
}

}  // namespace credo
