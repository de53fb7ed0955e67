#include "stages/segments/parts/thing_sides.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/convex_hull.hpp"
#include "geometry/ray_plane_fit.hpp"
#include "stages/segments/label_runs.hpp"
#include "stages/segments/parts/outlines.hpp"

namespace credo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using segments::LabelRuns;
using segments::PixelBox;

using Labels = std::vector<std::int32_t>;

/// So much of a side is beneath its top, and under it.
constexpr double kBeneath = 0.9;
/// Tops are level within 26 degrees: seen from nearby, lids and seats are known to so much.
constexpr double kTopCosine = 0.9;
/// Points are where they are told to be but for so much.
constexpr double kUncertain_quanta = 2.0;
/// Surfaces are known by the ends and middles of their runs in every fourth row (at the reference
/// focal length), if that is so many points.
constexpr double kRows_px = 4.0;
constexpr std::size_t kLeastPoints = 12;

struct Surface {
  std::vector<Vector3d> points_m;
  PixelBox box;
  RayPlaneFit fit;
  /// If its points span one.
  std::optional<Plane> plane;
};

/// Surfaces of all segments by label, and which of them are sides of which.
class SideFinder {
public:
  SideFinder(Segments const& segments, Grid<float> const& depth_m,
             CameraIntrinsics const& intrinsics, Vector3d const& up_camera,
             SegmentsConfig const& config)
      : segments_(segments),
        depth_m_(depth_m),
        intrinsics_(intrinsics),
        up_camera_(up_camera),
        east_(up_camera.unitOrthogonal()),
        north_(up_camera.cross(east_)),
        config_(config),
        surfaces_(segments.pixel_counts.size() + 1) {
    int const rows_px = std::max(1, static_cast<int>(std::lround(scaled(kRows_px))));
    LabelRuns runs(segments.labels.width());
    for (int v = 0; v < segments.labels.height(); v += rows_px) {
      std::span<std::int32_t const> const row = segments.labels.row(v);
      runs.find(row);
      for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
        end = runs.end(begin);
        if (row[begin] != 0) {
          add({static_cast<int>(begin), v}, {static_cast<int>(end) - 1, v});
        }
      }
    }
    for (Surface& surface : surfaces_) {
      surface.plane = surface.fit.plane();
      surface.box = surface.box.grown(rows_px, depth_m.width(), depth_m.height());
    }
  }

  /// By label the top of each, itself where it is nothing's side.
  Labels tops() && {
    Labels tops(surfaces_.size());
    std::iota(tops.begin(), tops.end(), 0);
    for (std::size_t top = 1; top < surfaces_.size(); ++top) {
      if (is_known(top) && upward_cosine(surfaces_[top]) > kTopCosine) {
        look_under(static_cast<std::int32_t>(top), tops);
      }
    }
    return tops;
  }

private:
  [[nodiscard]] double scaled(double at_reference_px) const {
    return at_reference_px * intrinsics_.fx_px / kReferenceFocal_px;
  }

  /// The pixels of a run from first to last.
  void add(Pixel first, Pixel last) {
    Surface& surface = surfaces_[static_cast<std::size_t>(segments_.labels[first])];
    surface.box.add({first, last});
    for (int const u : {first.u, (first.u + last.u) / 2, last.u}) {
      auto const z_m = static_cast<double>(depth_m_[Pixel{u, first.v}]);
      Vector3d const point_m((u - intrinsics_.cx_px) / intrinsics_.fx_px * z_m,
                             (first.v - intrinsics_.cy_px) / intrinsics_.fy_px * z_m, z_m);
      surface.fit.add(point_m);
      surface.points_m.push_back(point_m);
    }
  }

  [[nodiscard]] bool is_known(std::size_t label) const {
    return surfaces_[label].points_m.size() >= kLeastPoints && surfaces_[label].plane &&
           (segments_.lies_on.empty() || segments_.lies_on[label - 1] == 0);
  }

  /// 1 where a surface is level.
  [[nodiscard]] double upward_cosine(Surface const& surface) const {
    return surface.plane->normal.dot(up_camera_);
  }

  void look_under(std::int32_t label, Labels& tops) {
    Surface const& top = surfaces_[static_cast<std::size_t>(label)];
    std::vector<Vector2d> outline_m;
    for (std::size_t side = 1; side < surfaces_.size(); ++side) {
      Surface const& surface = surfaces_[side];
      if (!is_known(side) || upward_cosine(surface) > segments::kLevelCosine ||
          tops[side] != static_cast<std::int32_t>(side) ||
          surface.box.shared_with(top.box).empty() || !is_beneath(surface, top)) {
        continue;
      }
      if (outline_m.empty()) {
        outline_m = outline_of(top);
      }
      if (is_under(surface, top, outline_m) &&
          touch(static_cast<std::int32_t>(side), label, surface.box.shared_with(top.box))) {
        tops[side] = label;
      }
    }
  }

  template <typename Predicate>
  static bool holds_for_most(Surface const& surface, Predicate const& predicate) {
    auto left = static_cast<std::ptrdiff_t>((1.0 - kBeneath) *
                                            static_cast<double>(surface.points_m.size()));
    return std::ranges::all_of(surface.points_m, [&](Vector3d const& point_m) {
      return predicate(point_m) || left-- > 0;
    });
  }

  static bool is_beneath(Surface const& side, Surface const& top) {
    return holds_for_most(
        side, [&](Vector3d const& point_m) { return top.plane->signed_distance_m(point_m) < 0.0; });
  }

  /// Whether a surface that is beneath another is under its outline, and is seen from beside it:
  /// rays come through the other's plane farther out. What is seen beyond its far edge has it the
  /// other way round.
  [[nodiscard]] bool is_under(Surface const& side, Surface const& top,
                              std::vector<Vector2d> const& outline_m) const {
    return holds_for_most(side, [&](Vector3d const& point_m) {
      double const inside_m = depth_inside(outline_m, from_above(point_m));
      Vector3d const through_m = point_m * top.plane->offset_m / top.plane->normal.dot(point_m);
      double const uncertain_m =
          kUncertain_quanta * config_.quantum_per_m * point_m.z() * point_m.z();
      return inside_m >= -uncertain_m && inside_m > depth_inside(outline_m, from_above(through_m));
    });
  }

  /// Convex, seen from above.
  [[nodiscard]] std::vector<Vector2d> outline_of(Surface const& surface) const {
    std::vector<Vector2d> from_above_m(surface.points_m.size());
    std::ranges::transform(surface.points_m, from_above_m.begin(),
                           [&](Vector3d const& point_m) { return from_above(point_m); });
    return convex_polygon(std::move(from_above_m));
  }

  [[nodiscard]] Vector2d from_above(Vector3d const& point_m) const {
    return {east_.dot(point_m), north_.dot(point_m)};
  }

  [[nodiscard]] bool touch(std::int32_t a, std::int32_t b, PixelBox const& within) const {
    std::uint32_t pairs = 0;
    for (int v = within.first.v; v <= within.last.v; ++v) {
      for (int u = within.first.u; u <= within.last.u; ++u) {
        pairs += u < within.last.u && is_touch(a, b, {u, v}, {u + 1, v}) ? 1U : 0U;
        pairs += v < within.last.v && is_touch(a, b, {u, v}, {u, v + 1}) ? 1U : 0U;
      }
    }
    return pairs >= segments::least_touching_pairs(intrinsics_.fx_px);
  }

  /// Whether no jump of depth is between neighbours of those labels.
  [[nodiscard]] bool is_touch(std::int32_t a, std::int32_t b, Pixel p, Pixel q) const {
    std::int32_t const at_p = segments_.labels[p];
    std::int32_t const at_q = segments_.labels[q];
    return ((at_p == a && at_q == b) || (at_p == b && at_q == a)) &&
           std::abs(1.0F / depth_m_[p] - 1.0F / depth_m_[q]) <
               static_cast<float>(config_.link_quanta * config_.quantum_per_m);
  }

  Segments const& segments_;
  Grid<float> const& depth_m_;
  CameraIntrinsics const& intrinsics_;
  Vector3d up_camera_;
  /// Level, and at right angles.
  Vector3d east_;
  Vector3d north_;
  SegmentsConfig const& config_;
  std::vector<Surface> surfaces_;
};

/// `tops` by new labels: what is joined has the lower label, and those after it move up.
Labels numbered(Labels const& tops) {
  Labels lowest(tops.size());
  std::iota(lowest.begin(), lowest.end(), 0);
  for (std::size_t label = 1; label < tops.size(); ++label) {
    auto& of_top = lowest[static_cast<std::size_t>(tops[label])];
    of_top = std::min(of_top, static_cast<std::int32_t>(label));
  }
  Labels numbers(tops.size(), 0);
  std::int32_t count = 0;
  for (std::size_t label = 1; label < tops.size(); ++label) {
    std::int32_t const of_all = lowest[static_cast<std::size_t>(tops[label])];
    numbers[label] = of_all == static_cast<std::int32_t>(label)
                         ? ++count
                         : numbers[static_cast<std::size_t>(of_all)];
  }
  return numbers;
}

}  // namespace

Segments join_sides(Segments segments, Grid<float> const& depth_m,
                    CameraIntrinsics const& intrinsics,
                    std::optional<Eigen::Vector3d> const& up_camera, SegmentsConfig const& config) {
  if (!up_camera) {
    return segments;
  }
  Labels const tops = SideFinder(segments, depth_m, intrinsics, *up_camera, config).tops();
  Labels const numbers = numbered(tops);
  auto const count = static_cast<std::size_t>(std::ranges::max(numbers));
  if (count == segments.pixel_counts.size()) {
    return segments;
  }
  for (int v = 0; v < segments.labels.height(); ++v) {
    for (std::int32_t& label : segments.labels.row(v)) {
      label = numbers[static_cast<std::size_t>(label)];
    }
  }
  auto const place = [&](std::size_t label) {
    return static_cast<std::size_t>(numbers[label] - 1);
  };
  std::vector<std::uint32_t> pixel_counts(count, 0);
  for (std::size_t label = 1; label < numbers.size(); ++label) {
    pixel_counts[place(label)] += segments.pixel_counts[label - 1];
  }
  if (!segments.lies_on.empty()) {
    Labels lies_on(count, 0);
    for (std::size_t label = 1; label < numbers.size(); ++label) {
      if (std::int32_t const base = segments.lies_on[label - 1]; base != 0) {
        lies_on[place(label)] = numbers[static_cast<std::size_t>(base)];
      }
    }
    segments.lies_on = std::move(lies_on);
  }
  segments.pixel_counts = std::move(pixel_counts);
  return segments;
}

}  // namespace credo
