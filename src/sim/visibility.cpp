#include "sim/visibility.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/solid.hpp"
#include "sim/thing.hpp"

namespace credo {
namespace {

constexpr int kMaxRaysPerSide = 64;
/// Nearer corners have no place in a picture.
constexpr double kNearest_m = 1e-6;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// A thing and where the camera stands before it.
struct ThingView {
  std::vector<Solid> solids;
  Eigen::Matrix3d R_thing_camera;
  Eigen::Vector3d eye_thing;

  ThingView(SceneThing const& thing, Se3 const& T_world_camera) : solids(solids_of(thing)) {
    Se3 const T_thing_camera = pose_of(thing).inverse() * T_world_camera;
    R_thing_camera = T_thing_camera.rotation().toRotationMatrix();
    eye_thing = T_thing_camera.translation();
  }

  /// Depth where a ray of length 1 along the optical axis comes in; infinite where it misses.
  [[nodiscard]] double depth_along(Eigen::Vector3d const& ray_camera) const {
    Eigen::Vector3d const ray = R_thing_camera * ray_camera;
    double nearest = kFar;
    for (Solid const& solid : solids) {
      if (auto const entry = enter(solid, eye_thing, ray); entry.has_value()) {
        nearest = std::min(nearest, entry->distance);
      }
    }
    return nearest;
  }
};

/// Pixels from low to high, some of them outside the picture.
struct Span {
  int low;
  int high;

  [[nodiscard]] int stride() const {
    return std::max(1, (high - low + kMaxRaysPerSide) / kMaxRaysPerSide);
  }
};

/// One picture beyond each edge, the picture having `size` pixels.
Span widest(int size) {
  return {-size, 2 * size - 1};
}

Span clipped(double low, double high, int size) {
  Span const all = widest(size);
  // In doubles, as what is seen at a grazing angle may be too far out for an int.
  return {static_cast<int>(std::clamp(std::floor(low), double(all.low), all.high + 1.0)),
          static_cast<int>(std::clamp(std::ceil(high), all.low - 1.0, double(all.high)))};
}

struct Rectangle {
  Span u;
  Span v;
};

/// Around all that the thing may cover.
Rectangle rectangle_of(ThingView const& view, SceneCamera const& camera) {
  Eigen::AlignedBox3d box;
  for (Solid const& solid : view.solids) {
    box.extend(bounds_of(solid));
  }
  Eigen::AlignedBox2d image;
  for (int i = 0; i < 8; ++i) {
    Eigen::Vector3d const corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    Eigen::Vector3d const p = view.R_thing_camera.transpose() * (corner - view.eye_thing);
    if (p.z() < kNearest_m) {
      return {widest(camera.width_px), widest(camera.height_px)};
    }
    image.extend(Eigen::Vector2d(camera.fx_px * p.x() / p.z() + camera.cx_px,
                                 camera.fy_px * p.y() / p.z() + camera.cy_px));
  }
  return {clipped(image.min().x(), image.max().x(), camera.width_px),
          clipped(image.min().y(), image.max().y(), camera.height_px)};
}

}  // namespace

double visible_fraction(SceneCamera const& camera, PresentThings const& things, std::size_t thing,
                        Se3 const& T_world_camera) {
  if (!things[thing].has_value()) {
    return 0.0;
  }
  ThingView const view(*things[thing], T_world_camera);
  std::vector<ThingView> others;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (i != thing && things[i].has_value()) {
      others.emplace_back(*things[i], T_world_camera);
    }
  }
  Rectangle const image = rectangle_of(view, camera);
  int covered = 0;
  int seen = 0;
  for (int v = image.v.low; v <= image.v.high; v += image.v.stride()) {
    for (int u = image.u.low; u <= image.u.high; u += image.u.stride()) {
      Eigen::Vector3d const ray((u - camera.cx_px) / camera.fx_px,
                                (v - camera.cy_px) / camera.fy_px, 1.0);
      double const depth_m = view.depth_along(ray);
      if (depth_m == kFar) {
        continue;
      }
      ++covered;
      bool const inside = u >= 0 && u < camera.width_px && v >= 0 && v < camera.height_px;
      bool const measured = depth_m >= camera.min_range_m && depth_m <= camera.max_range_m;
      if (inside && measured && std::none_of(others.begin(), others.end(), [&](auto const& other) {
            return other.depth_along(ray) < depth_m;
          })) {
        ++seen;
      }
    }
  }
  return covered > 0 ? static_cast<double>(seen) / covered : 0.0;
}

}  // namespace credo
