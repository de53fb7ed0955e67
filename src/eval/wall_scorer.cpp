#include "eval/wall_scorer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <tuple>
#include <vector>

namespace credo {
namespace {

constexpr double kMaxTilt_rad = 10.0 * std::numbers::pi / 180.0;
constexpr double kMaxOffset_m = 0.1;

/// Where on the wall, from its segment's start, the ray of a pixel meets it; none where it does
/// not.
std::optional<double> place_along(TrueWall const& wall, Eigen::Vector3d const& origin_world,
                                  Eigen::Vector3d const& ray_world) {
  Eigen::Vector3d const start(wall.segment_start_m.x(), wall.segment_start_m.y(), 0.0);
  double const along_normal = wall.normal.dot(ray_world);
  if (std::abs(along_normal) < 1e-9) {
    return std::nullopt;
  }
  double const range = wall.normal.dot(start - origin_world) / along_normal;
  Eigen::Vector2d const segment = wall.segment_end_m - wall.segment_start_m;
  Eigen::Vector2d const hit = (origin_world + range * ray_world).head<2>();
  double const length_m = segment.norm();
  double const along_m = (hit - wall.segment_start_m).dot(segment) / length_m;
  return range > 0.0 ? std::optional(std::clamp(along_m, 0.0, length_m)) : std::nullopt;
}

struct Extent {
  double low_m;
  double high_m;
};

/// Of the believed wall along the true one; none where it does not lie along it.
std::optional<Extent> extent_along(WallSummary const& believed, TrueWall const& wall) {
  Eigen::Vector2d const segment = wall.segment_end_m - wall.segment_start_m;
  Eigen::Vector2d const direction = segment.normalized();
  Eigen::Vector2d const across(-direction.y(), direction.x());
  double const cosine = std::abs(believed.normal.dot(wall.normal));
  Eigen::Vector2d const middle = 0.5 * (believed.segment_start_m + believed.segment_end_m);
  if (cosine < std::cos(kMaxTilt_rad) ||
      std::abs((middle - wall.segment_start_m).dot(across)) > kMaxOffset_m) {
    return std::nullopt;
  }
  double const a_m = (believed.segment_start_m - wall.segment_start_m).dot(direction);
  double const b_m = (believed.segment_end_m - wall.segment_start_m).dot(direction);
  return Extent{std::min(a_m, b_m), std::max(a_m, b_m)};
}

/// The same along any of a wall's faces.
std::optional<Extent> extent_along(WallSummary const& believed,
                                   std::vector<TrueWall> const& faces) {
  for (TrueWall const& face : faces) {
    if (std::optional<Extent> const extent = extent_along(believed, face)) {
      return extent;
    }
  }
  return std::nullopt;
}

}  // namespace

void WallScorer::see(FrameTruth const& truth, LabelMap const& true_labels,
                     CameraIntrinsics const& intrinsics) {
  std::map<LabelCode, TrueWall const*> walls;
  std::map<LabelCode, std::uint64_t> pixels;
  for (TrueWall const& wall : truth.walls) {
    if ((wall.segment_end_m - wall.segment_start_m).norm() > 0.0) {
      walls[wall.label] = &wall;
    }
  }
  for (std::size_t i = 0; i < true_labels.size(); ++i) {
    if (!is_wall(true_labels[i])) {
      continue;
    }
    auto const found = walls.find(true_labels[i]);
    if (found == walls.end()) {
      continue;
    }
    Pixel const p = true_labels.pixel(i);
    Eigen::Vector3d const ray_camera((p.u - intrinsics.cx_px) / intrinsics.fx_px,
                                     (p.v - intrinsics.cy_px) / intrinsics.fy_px, 1.0);
    auto const along_m = place_along(*found->second, truth.T_world_camera.translation(),
                                     truth.T_world_camera.rotation() * ray_camera);
    if (!along_m) {
      continue;
    }
    auto const [it, is_new] =
        seen_.try_emplace(found->second->id, Seen{*along_m, *along_m, false, {}});
    it->second.low_m = std::min(it->second.low_m, *along_m);
    it->second.high_m = std::max(it->second.high_m, *along_m);
    ++pixels[true_labels[i]];
  }
  for (auto const& [label, count] : pixels) {
    TrueWall const& face = *walls.at(label);
    Seen& seen = seen_[face.id];
    if (std::none_of(seen.faces.begin(), seen.faces.end(),
                     [&](TrueWall const& known) { return known.normal.dot(face.normal) > 0.0; })) {
      seen.faces.push_back(face);
    }
    seen.enough = seen.enough || count * 100 >= true_labels.size();
  }
}

void WallScorer::add(BeliefSummary const& belief, FrameTruth const& truth) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // minus overlap, believed, true
  for (std::size_t b = 0; b < belief.walls.size(); ++b) {
    for (std::size_t t = 0; t < truth.walls.size(); ++t) {
      auto const seen = seen_.find(truth.walls[t].id);
      if (seen == seen_.end()) {
        continue;
      }
      auto const extent = extent_along(belief.walls[b], seen->second.faces);
      if (!extent) {
        continue;
      }
      double const common_m = std::min(extent->high_m, seen->second.high_m) -
                              std::max(extent->low_m, seen->second.low_m);
      if (common_m > 0.0 && common_m >= 0.5 * (extent->high_m - extent->low_m)) {
        pairs.emplace_back(-common_m, b, t);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> right(belief.walls.size(), false);
  std::vector<bool> found(truth.walls.size(), false);
  for (auto const& [overlap, b, t] : pairs) {
    if (right[b] || found[t]) {
      continue;
    }
    right[b] = true;
    found[t] = true;
    Seen const& seen = seen_.at(truth.walls[t].id);
    Extent const extent = *extent_along(belief.walls[b], seen.faces);
    endpoint_m_.add(std::abs(extent.low_m - seen.low_m));
    endpoint_m_.add(std::abs(extent.high_m - seen.high_m));
  }
  for (bool const is_right : right) {
    precise_.add(is_right ? 1.0 : 0.0);
  }
  for (std::size_t t = 0; t < truth.walls.size(); ++t) {
    auto const seen = seen_.find(truth.walls[t].id);
    if (seen != seen_.end() && seen->second.enough) {
      recalled_.add(found[t] ? 1.0 : 0.0);
    }
  }
}

WallScores WallScorer::scores() const {
  return {precise_.value(), recalled_.value(), endpoint_m_.value()};
}

}  // namespace credo
