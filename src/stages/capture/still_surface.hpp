#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/plane.hpp"
#include "geometry/plane_search.hpp"
#include "geometry/ray_plane_fit.hpp"

namespace credo {

/// A plane that a camera which stands still sees in many frames. Camera frame.
struct StillSurface {
  /// Fitted to the inliers of all frames at once; the normal faces the camera.
  Plane plane;
  /// Of each frame by itself, by the same inliers; none where too few of its points lie on it.
  std::vector<std::optional<Plane>> by_frame;
  /// How many frames have one.
  int frame_count = 0;
  /// Points of all frames that the plane was fitted to, and the root of their mean squared
  /// distance.
  std::size_t point_count = 0;
  double rms_m = 0.0;
  /// How far an inlier may be off in inverse depth: three standard deviations.
  double gate_per_m = 0.0;
};

/// How points become a plane: RayPlaneFit::plane, or one that holds a direction.
using PlaneOfSums = std::function<std::optional<Plane>(RayPlaneFit const&)>;

/// Fits from a first guess: the points near it (their tolerance_m), then those within three
/// standard deviations, which are told by the median (the noise of this sensor and surface, not a
/// constant), and so on for a few rounds. None where the points near the guess do not carry a
/// plane.
std::optional<StillSurface> fit_still_surface(std::span<PlaneSearchPoints const> frames,
                                              Plane const& guess, PlaneOfSums const& plane_of);

}  // namespace credo
