#include "geometry/convex_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <set>
#include <utility>

namespace credo {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kShake = 1e-6;

Points shaken(Points points) {
  Eigen::AlignedBox3d box;
  for (Eigen::Vector3d const& point : points) {
    box.extend(point);
  }
  double const size = box.diagonal().norm();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> shake(-kShake * size, kShake * size);
  for (Eigen::Vector3d& point : points) {
    for (double& value : point) {
      value += shake(random);
    }
  }
  return points;
}

/// Six times the volume of the tetrahedron; positive where `point` is on the outer side.
double above(Points const& points, HullFace const& face, Eigen::Vector3d const& point) {
  Eigen::Vector3d const& a = points[face[0]];
  return (points[face[1]] - a).cross(points[face[2]] - a).dot(point - a);
}

/// Four points far from each other; none where the points are all but in one plane.
std::vector<HullFace> first_tetrahedron(Points const& points) {
  auto const farthest = [&](auto const& measure) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < points.size(); ++i) {
      best = measure(points[i]) > measure(points[best]) ? i : best;
    }
    return best;
  };
  std::uint32_t const a = farthest([](Eigen::Vector3d const& p) { return p.x(); });
  std::uint32_t const b =
      farthest([&](Eigen::Vector3d const& p) { return (p - points[a]).squaredNorm(); });
  Eigen::Vector3d const ab = points[b] - points[a];
  std::uint32_t const c =
      farthest([&](Eigen::Vector3d const& p) { return ab.cross(p - points[a]).squaredNorm(); });
  std::uint32_t const d = farthest([&](Eigen::Vector3d const& p) {
    return std::abs(above(points, {a, b, c}, p));
  });
  double const area2 = ab.cross(points[c] - points[a]).norm();
  if (!(std::abs(above(points, {a, b, c}, points[d])) > 10.0 * kShake * ab.norm() * area2)) {
    return {};
  }
  if (above(points, {a, b, c}, points[d]) > 0.0) {
    return {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
  }
  return {{a, b, c}, {b, a, d}, {c, b, d}, {a, c, d}};
}

}  // namespace

std::vector<HullFace> convex_hull(Points const& given) {
  if (given.size() < 4) {
    return {};
  }
  Points const points = shaken(given);
  std::vector<HullFace> faces = first_tetrahedron(points);
  if (faces.empty()) {
    return {};
  }
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    auto const seen = std::partition(faces.begin(), faces.end(), [&](HullFace const& face) {
      bool const is_corner = std::ranges::find(face, i) != face.end();
      return is_corner || above(points, face, points[i]) <= 0.0;
    });
    if (seen == faces.end()) {
      continue;
    }
    // The rim of what the point sees: edges whose other side it does not.
    std::set<std::pair<std::uint32_t, std::uint32_t>> rim;
    for (auto face = seen; face != faces.end(); ++face) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::pair const edge{(*face)[k], (*face)[(k + 1) % 3]};
        if (rim.erase({edge.second, edge.first}) == 0) {
          rim.insert(edge);
        }
      }
    }
    faces.erase(seen, faces.end());
    for (auto const& [begin, end] : rim) {
      faces.push_back({begin, end, i});
    }
  }
  return faces;
}

std::vector<Eigen::Vector2d> convex_polygon(std::vector<Eigen::Vector2d> points) {
  std::ranges::sort(points, {}, [](Eigen::Vector2d const& p) { return std::pair(p.x(), p.y()); });
  std::vector<Eigen::Vector2d> hull;
  auto const add_chain = [&](auto begin, auto end) {
    std::size_t const start = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= start + 2) {
        Eigen::Vector2d const last = hull.back() - hull[hull.size() - 2];
        Eigen::Vector2d const next = *point - hull.back();
        if (last.x() * next.y() - last.y() * next.x() > 0.0) {
          break;
        }
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    if (!hull.empty()) {
      hull.pop_back();  // it begins the other chain
    }
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

double depth_inside(std::vector<Eigen::Vector2d> const& polygon, Eigen::Vector2d const& point) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Eigen::Vector2d const side = polygon[(i + 1) % polygon.size()] - polygon[i];
    Eigen::Vector2d const to = point - polygon[i];
    depth = std::min(depth, (side.x() * to.y() - side.y() * to.x()) / side.norm());
  }
  return polygon.size() < 3 ? -std::numeric_limits<double>::infinity() : depth;
}

}  // namespace credo
