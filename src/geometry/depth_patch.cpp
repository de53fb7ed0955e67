#include "geometry/depth_patch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace credo {
namespace {

constexpr float kNearest_m = 0.01F;

/// A vertex in the image.
struct Projected {
  float u_px = 0.0F;
  float v_px = 0.0F;
  /// Not positive: too near to be drawn.
  float per_m = 0.0F;
};

std::vector<Projected> project(std::span<Eigen::Vector3f const> vertices,
                               CameraIntrinsics const& intrinsics) {
  auto const fx = static_cast<float>(intrinsics.fx_px);
  auto const fy = static_cast<float>(intrinsics.fy_px);
  auto const cx = static_cast<float>(intrinsics.cx_px);
  auto const cy = static_cast<float>(intrinsics.cy_px);
  std::vector<Projected> projected(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Eigen::Vector3f const& p = vertices[i];
    if (p.z() >= kNearest_m) {
      float const per_m = 1.0F / p.z();
      projected[i] = {fx * p.x() * per_m + cx, fy * p.y() * per_m + cy, per_m};
    }
  }
  return projected;
}

/// First and last pixel of a row or column.
struct PixelSpan {
  int first = 0;
  int last = -1;
};

PixelSpan span_of(float low_px, float high_px, int size_px) {
  auto const size = static_cast<float>(size_px);
  return {static_cast<int>(std::ceil(std::clamp(low_px, 0.0F, size))),
          static_cast<int>(std::floor(std::clamp(high_px, -1.0F, size - 1.0F)))};
}

/// What the projected triangles cover at most.
struct Bounds {
  float low_u = std::numeric_limits<float>::infinity();
  float low_v = std::numeric_limits<float>::infinity();
  float high_u = -std::numeric_limits<float>::infinity();
  float high_v = -std::numeric_limits<float>::infinity();
};

Bounds bounds_of(std::vector<Projected> const& projected) {
  Bounds bounds;
  for (Projected const& p : projected) {
    if (p.per_m > 0.0F) {
      bounds.low_u = std::min(bounds.low_u, p.u_px);
      bounds.low_v = std::min(bounds.low_v, p.v_px);
      bounds.high_u = std::max(bounds.high_u, p.u_px);
      bounds.high_v = std::max(bounds.high_v, p.v_px);
    }
  }
  return bounds;
}

/// Twice the area of the triangle a, b, (u, v): affine in u and v.
struct EdgeFunction {
  EdgeFunction(Projected const& a, Projected const& b)
      : per_u(a.v_px - b.v_px),
        per_v(b.u_px - a.u_px),
        at_origin(-a.u_px * per_u - a.v_px * per_v) {}
  [[nodiscard]] float at(float u, float v) const { return u * per_u + v * per_v + at_origin; }

  float per_u;
  float per_v;
  float at_origin;
};

/// A pixel on the edge of two triangles is drawn by one of them at least, whatever is rounded.
constexpr float kOnEdge = -1e-5F;

/// Draws one triangle, whose `per_m` are all positive.
void draw(Projected const& a, Projected const& b, Projected const& c, DepthPatch& patch,
          Grid<float>& nearest_per_m) {
  float const area = (b.u_px - a.u_px) * (c.v_px - a.v_px) - (c.u_px - a.u_px) * (b.v_px - a.v_px);
  if (area == 0.0F) {
    return;
  }
  int const du = patch.corner.u;
  int const dv = patch.corner.v;
  PixelSpan const us =
      span_of(std::min({a.u_px, b.u_px, c.u_px}) - static_cast<float>(du),
              std::max({a.u_px, b.u_px, c.u_px}) - static_cast<float>(du), nearest_per_m.width());
  PixelSpan const vs =
      span_of(std::min({a.v_px, b.v_px, c.v_px}) - static_cast<float>(dv),
              std::max({a.v_px, b.v_px, c.v_px}) - static_cast<float>(dv), nearest_per_m.height());
  if (us.last < us.first) {
    return;
  }
  float const inverse = 1.0F / area;
  EdgeFunction const of_c(a, b);
  EdgeFunction const of_a(b, c);
  EdgeFunction const of_b(c, a);
  for (int v = vs.first; v <= vs.last; ++v) {
    auto const image_v = static_cast<float>(v + dv);
    auto const image_u = static_cast<float>(us.first + du);
    float wa = of_a.at(image_u, image_v) * inverse;
    float wb = of_b.at(image_u, image_v) * inverse;
    float wc = of_c.at(image_u, image_v) * inverse;
    float* row = nearest_per_m.row(v).data();
    for (int u = us.first; u <= us.last; ++u) {
      if (wa >= kOnEdge && wb >= kOnEdge && wc >= kOnEdge) {
        row[u] = std::max(row[u], wa * a.per_m + wb * b.per_m + wc * c.per_m);
      }
      wa += of_a.per_u * inverse;
      wb += of_b.per_u * inverse;
      wc += of_c.per_u * inverse;
    }
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> facing_camera(
    std::span<Eigen::Vector3f const> vertices_camera,
    std::span<std::array<std::uint32_t, 3> const> triangles) {
  std::vector<std::array<std::uint32_t, 3>> facing;
  facing.reserve(triangles.size());
  for (auto const& triangle : triangles) {
    Eigen::Vector3f const& a = vertices_camera[triangle[0]];
    Eigen::Vector3f const ab = vertices_camera[triangle[1]] - a;
    Eigen::Vector3f const ac = vertices_camera[triangle[2]] - a;
    if (ab.cross(ac).dot(a) < 0.0F) {
      facing.push_back(triangle);
    }
  }
  return facing;
}

DepthPatch render_depth(std::span<Eigen::Vector3f const> vertices_camera,
                        std::span<std::array<std::uint32_t, 3> const> triangles,
                        CameraIntrinsics const& intrinsics, ImageSize size) {
  std::vector<Projected> const projected = project(vertices_camera, intrinsics);
  Bounds const bounds = bounds_of(projected);
  if (bounds.low_u > bounds.high_u) {
    return {};
  }
  PixelSpan const us = span_of(bounds.low_u, bounds.high_u, size.width_px);
  PixelSpan const vs = span_of(bounds.low_v, bounds.high_v, size.height_px);
  DepthPatch patch;
  if (us.last < us.first || vs.last < vs.first) {
    return patch;
  }
  patch.corner = {us.first, vs.first};
  Grid<float> nearest_per_m(us.last - us.first + 1, vs.last - vs.first + 1, 0.0F);
  for (auto const& [a, b, c] : triangles) {
    if (projected[a].per_m > 0.0F && projected[b].per_m > 0.0F && projected[c].per_m > 0.0F) {
      draw(projected[a], projected[b], projected[c], patch, nearest_per_m);
    }
  }
  patch.depth_m = std::move(nearest_per_m);
  for (float& value : patch.depth_m) {
    value = value > 0.0F ? 1.0F / value : kNoSurface_m;
  }
  return patch;
}

}  // namespace credo
