#include "geometry/depth_patch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "geometry/shapes/triangle_pixels.hpp"

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

/// Inverse depths in rows that triangles may be drawn into.
class NearestSurface {
public:
  NearestSurface(Pixel corner, int width_px, int height_px)
      : corner_(corner),
        width_px_(width_px),
        height_px_(height_px),
        stride_(static_cast<std::size_t>(width_px) + kTrianglePadding),
        per_m_(stride_ * static_cast<std::size_t>(height_px), 0.0F) {}

  /// The three `per_m` must be positive.
  void draw(Projected const& a, Projected const& b, Projected const& c);
  [[nodiscard]] DepthPatch patch() const;

private:
  Pixel corner_;
  int width_px_;
  int height_px_;
  std::size_t stride_;
  std::vector<float> per_m_;
};

void NearestSurface::draw(Projected const& a, Projected const& b, Projected const& c) {
  float const area = (b.u_px - a.u_px) * (c.v_px - a.v_px) - (c.u_px - a.u_px) * (b.v_px - a.v_px);
  if (area == 0.0F) {
    return;
  }
  auto const du = static_cast<float>(corner_.u);
  auto const dv = static_cast<float>(corner_.v);
  PixelSpan const us = span_of(std::min({a.u_px, b.u_px, c.u_px}) - du,
                               std::max({a.u_px, b.u_px, c.u_px}) - du, width_px_);
  PixelSpan const vs = span_of(std::min({a.v_px, b.v_px, c.v_px}) - dv,
                               std::max({a.v_px, b.v_px, c.v_px}) - dv, height_px_);
  if (us.last < us.first || vs.last < vs.first) {
    return;
  }
  float const u = du + static_cast<float>(us.first);
  float const v = dv + static_cast<float>(vs.first);
  float const inverse = 1.0F / area;
  // Of the triangle p, q, (u, v) in that of a, b, c.
  auto const weight = [&](Projected const& p, Projected const& q) {
    float const per_u = (p.v_px - q.v_px) * inverse;
    float const per_v = (q.u_px - p.u_px) * inverse;
    return AffineInImage{(u - p.u_px) * per_u + (v - p.v_px) * per_v, per_u, per_v};
  };
  AffineInImage const of_a = weight(b, c);
  AffineInImage const of_b = weight(c, a);
  AffineInImage const of_c = weight(a, b);
  auto const per_m = [&](float AffineInImage::*part) {
    return of_a.*part * a.per_m + of_b.*part * b.per_m + of_c.*part * c.per_m;
  };
  TriangleInImage const triangle{us.last - us.first + 1,
                                 vs.last - vs.first + 1,
                                 of_a,
                                 of_b,
                                 of_c,
                                 {per_m(&AffineInImage::at_corner), per_m(&AffineInImage::per_u),
                                  per_m(&AffineInImage::per_v)}};
  float* const top_left = per_m_.data() + static_cast<std::size_t>(vs.first) * stride_ +
                          static_cast<std::size_t>(us.first);
  draw_triangle(triangle, top_left, stride_);
}

DepthPatch NearestSurface::patch() const {
  DepthPatch patch{corner_, Grid<float>(width_px_, height_px_)};
  for (int v = 0; v < height_px_; ++v) {
    float const* const per_m = per_m_.data() + static_cast<std::size_t>(v) * stride_;
    auto const row = patch.depth_m.row(v);
    for (std::size_t u = 0; u < row.size(); ++u) {
      row[u] = per_m[u] > 0.0F ? 1.0F / per_m[u] : kNoSurface_m;
    }
  }
  return patch;
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
  if (us.last < us.first || vs.last < vs.first) {
    return {};
  }
  NearestSurface nearest({us.first, vs.first}, us.last - us.first + 1, vs.last - vs.first + 1);
  for (auto const& [a, b, c] : triangles) {
    if (projected[a].per_m > 0.0F && projected[b].per_m > 0.0F && projected[c].per_m > 0.0F) {
      nearest.draw(projected[a], projected[b], projected[c]);
    }
  }
  return nearest.patch();
}

}  // namespace credo
