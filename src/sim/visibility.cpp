#include "sim/visibility.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/thing.hpp"

namespace credo {
namespace {

constexpr int kMaxRaysPerSide = 64;
/// Nearer corners have no place in a picture.
constexpr double kNearest_m = 1e-6;

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
Rectangle rectangle_of(SceneThing const& thing, SceneCamera const& camera,
                       Se3 const& T_world_camera) {
  Se3 const T_camera_thing = T_world_camera.inverse() * pose_of(thing);
  Eigen::AlignedBox3d const box = bounds_of_thing(thing);
  Eigen::AlignedBox2d image;
  for (int i = 0; i < 8; ++i) {
    Eigen::Vector3d const p =
        T_camera_thing * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    if (p.z() < kNearest_m) {
      return {widest(camera.width_px), widest(camera.height_px)};
    }
    image.extend(Eigen::Vector2d(camera.fx_px * p.x() / p.z() + camera.cx_px,
                                 camera.fy_px * p.y() / p.z() + camera.cy_px));
  }
  return {clipped(image.min().x(), image.max().x(), camera.width_px),
          clipped(image.min().y(), image.max().y(), camera.height_px)};
}

std::vector<Pixel> pixels_of(Rectangle const& image) {
  std::vector<Pixel> pixels;
  for (int v = image.v.low; v <= image.v.high; v += image.v.stride()) {
    for (int u = image.u.low; u <= image.u.high; u += image.u.stride()) {
      pixels.push_back({u, v});
    }
  }
  return pixels;
}

}  // namespace

double visible_fraction(RayCaster const& world, std::size_t thing, Se3 const& T_world_camera) {
  if (!world.things()[thing].has_value()) {
    return 0.0;
  }
  SceneCamera const& camera = world.camera();
  std::vector<Pixel> const pixels =
      pixels_of(rectangle_of(*world.things()[thing], camera, T_world_camera));
  std::vector<PixelHit> const alone = world.look(T_world_camera, pixels, thing);
  std::size_t covered = 0;
  std::vector<Pixel> measured;
  std::vector<double> depths_m;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    auto const [u, v] = pixels[i];
    double const depth_m = alone[i].depth_m;
    covered += alone[i].thing.has_value() ? 1 : 0;
    bool const inside = u >= 0 && u < camera.width_px && v >= 0 && v < camera.height_px;
    if (inside && depth_m >= camera.min_range_m && depth_m <= camera.max_range_m) {
      measured.push_back(pixels[i]);
      depths_m.push_back(depth_m);
    }
  }
  std::vector<PixelHit> const all = world.look(T_world_camera, measured);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    // What lies in the same place, to the last digit, hides nothing.
    seen += all[i].depth_m == depths_m[i] ? 1 : 0;
  }
  return covered > 0 ? static_cast<double>(seen) / static_cast<double>(covered) : 0.0;
}

}  // namespace credo
