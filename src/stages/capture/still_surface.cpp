#include "stages/capture/still_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace credo {
namespace {

constexpr double kMaxAngle_rad = 0.5;       // coarse normals are noisy far away
constexpr double kLeastGate_per_m = 0.002;  // what millimetres and float leave of an exact plane
constexpr int kRounds = 8;
constexpr std::size_t kLeastPoints = 50;  // of a frame

/// What lies within the gate of a plane in one frame: as near as a plane search wants it, and
/// within a width in inverse depth.
class Gate {
public:
  Gate(Plane const& plane, double width_per_m)
      : plane_(plane), width_per_m_(width_per_m), least_cosine_(std::cos(kMaxAngle_rad)) {}

  /// Calls `use(point, error in inverse depth)` for each.
  template <typename Use>
  void for_each(PlaneSearchPoints const& points, Use const& use) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      Eigen::Vector3d const p(points.x[i], points.y[i], points.z[i]);
      double const error = inverse_depth_error_per_m(plane_, p);
      if (std::abs(error) > width_per_m_ ||
          std::abs(plane_.signed_distance_m(p)) > static_cast<double>(points.tolerance_m[i])) {
        continue;
      }
      Eigen::Vector3d const normal(points.normal_x[i], points.normal_y[i], points.normal_z[i]);
      // Without a normal (the picture's margin, beside a gap) distance alone decides.
      if (!(std::abs(normal.dot(plane_.normal)) < least_cosine_)) {
        use(p, error);
      }
    }
  }

private:
  Plane plane_;
  double width_per_m_;
  double least_cosine_;
};

/// Of what lies within the gate, by the median, which what does not belong there hardly moves.
double three_sigmas(std::span<PlaneSearchPoints const> frames, Gate const& gate) {
  std::vector<float> errors;
  for (PlaneSearchPoints const& frame : frames) {
    gate.for_each(frame, [&](Eigen::Vector3d const&, double error) {
      errors.push_back(static_cast<float>(std::abs(error)));
    });
  }
  if (errors.empty()) {
    return 0.0;
  }
  auto const middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return 3.0 * 1.4826 * static_cast<double>(*middle);
}

RayPlaneFit sums_within(std::span<PlaneSearchPoints const> frames, Gate const& gate) {
  RayPlaneFit sums;
  for (PlaneSearchPoints const& frame : frames) {
    gate.for_each(frame, [&](Eigen::Vector3d const& p, double) { sums.add(p); });
  }
  return sums;
}

double rms_m(std::span<PlaneSearchPoints const> frames, Gate const& gate, Plane const& plane) {
  double squares = 0.0;
  std::size_t count = 0;
  for (PlaneSearchPoints const& frame : frames) {
    gate.for_each(frame, [&](Eigen::Vector3d const& p, double) {
      squares += std::pow(plane.signed_distance_m(p), 2);
      ++count;
    });
  }
  return count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count));
}

}  // namespace

std::optional<StillSurface> fit_still_surface(std::span<PlaneSearchPoints const> frames,
                                              Plane const& guess, PlaneOfSums const& plane_of) {
  Plane plane = guess;
  double width_per_m = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    RayPlaneFit const sums = sums_within(frames, Gate(plane, width_per_m));
    std::optional<Plane> const fit = plane_of(sums);
    if (!fit || sums.point_count() < kLeastPoints) {
      return std::nullopt;
    }
    plane = *fit;
    width_per_m = std::max(three_sigmas(frames, Gate(plane, width_per_m)), kLeastGate_per_m);
  }
  Gate const gate(plane, width_per_m);
  StillSurface surface;
  surface.gate_per_m = width_per_m;
  RayPlaneFit all;
  for (PlaneSearchPoints const& frame : frames) {
    RayPlaneFit const own = sums_within({&frame, 1}, gate);
    std::optional<Plane> const fit =
        own.point_count() >= kLeastPoints ? plane_of(own) : std::nullopt;
    surface.by_frame.push_back(fit);
    surface.frame_count += fit ? 1 : 0;
    all.add(own);
  }
  surface.plane = plane_of(all).value_or(plane);
  surface.point_count = all.point_count();
  surface.rms_m = rms_m(frames, gate, surface.plane);
  return surface;
}

}  // namespace credo
