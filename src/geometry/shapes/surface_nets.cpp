#include "geometry/shapes/surface_nets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace credo {
namespace {

/// A point tells of the distance to the surface so many spacings away.
constexpr float kReach_spacings = 2.0F;
/// Points whose normals lie further from the nearest point's are of another side.
constexpr float kSameSideCosine = 0.5F;
constexpr std::size_t kLeastPieceShare = 20;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A corner of the grid.
struct Corner {
  std::uint32_t nearest = kNone;
  float nearest_squared = std::numeric_limits<float>::infinity();
  float weights = 0.0F;
  float weighted = 0.0F;

  [[nodiscard]] bool is_known() const { return weights > 0.0F; }
  /// To the surface, positive outside.
  [[nodiscard]] float distance_m() const { return weighted / weights; }
};

class DistanceGrid {
public:
  DistanceGrid(std::span<OrientedPoint const> points, float spacing_m)
      : points_(points), spacing_m_(spacing_m) {
    Eigen::AlignedBox3f bounds;
    for (OrientedPoint const& p : points) {
      bounds.extend(p.point);
    }
    float const margin_m = (kReach_spacings + 1.0F) * spacing_m;
    origin_ = bounds.min() - Eigen::Vector3f::Constant(margin_m);
    Eigen::Vector3f const size_m = bounds.sizes() + Eigen::Vector3f::Constant(2.0F * margin_m);
    size_ = (size_m / spacing_m).array().ceil().cast<int>() + 1;
    step_ = {1, static_cast<std::size_t>(size_.x()),
             static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y())};
    corners_.resize(step_[2] * static_cast<std::size_t>(size_.z()));
    find_nearest();
    add_distances();
  }

  [[nodiscard]] Eigen::Array3i const& size() const { return size_; }
  [[nodiscard]] std::size_t count() const { return corners_.size(); }
  [[nodiscard]] std::size_t step(std::size_t axis) const { return step_[axis]; }
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) + static_cast<std::size_t>(y) * step_[1] +
           static_cast<std::size_t>(z) * step_[2];
  }
  [[nodiscard]] Corner const& operator[](std::size_t i) const { return corners_[i]; }
  [[nodiscard]] Eigen::Vector3f position(Eigen::Vector3f const& in_cells) const {
    return origin_ + spacing_m_ * in_cells;
  }
  /// The surface was seen near a vertex of a cell.
  [[nodiscard]] bool was_seen(Eigen::Vector3f const& vertex, std::size_t cell) const {
    for (std::size_t k = 0; k < 8; ++k) {
      Corner const& corner = corners_[corner_of(cell, k)];
      if ((points_[corner.nearest].point - vertex).squaredNorm() <= spacing_m_ * spacing_m_) {
        return true;
      }
    }
    return false;
  }
  /// The eight corners of a cell, by the bits of k.
  [[nodiscard]] std::size_t corner_of(std::size_t cell, std::size_t k) const {
    return cell + (k & 1U) * step_[0] + (k >> 1U & 1U) * step_[1] + (k >> 2U & 1U) * step_[2];
  }

private:
  /// Calls with all corners in reach of a point, and their offsets from it.
  template <typename Visit>
  void around(Eigen::Vector3f const& point, Visit const& visit) {
    Eigen::Array3f const place = ((point - origin_) / spacing_m_).array();
    Eigen::Array3i const low = (place - kReach_spacings).ceil().cast<int>();
    Eigen::Array3i const high = (place + kReach_spacings).floor().cast<int>();
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          Eigen::Vector3f const offset = position(Eigen::Vector3i(x, y, z).cast<float>()) - point;
          visit(corners_[index(x, y, z)], offset);
        }
      }
    }
  }

  void find_nearest() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      around(points_[i].point, [&](Corner& corner, Eigen::Vector3f const& offset) {
        if (offset.squaredNorm() < corner.nearest_squared) {
          corner.nearest_squared = offset.squaredNorm();
          corner.nearest = static_cast<std::uint32_t>(i);
        }
      });
    }
  }

  void add_distances() {
    float const reach_m = kReach_spacings * spacing_m_;
    for (OrientedPoint const& p : points_) {
      around(p.point, [&](Corner& corner, Eigen::Vector3f const& offset) {
        float const left = 1.0F - offset.squaredNorm() / (reach_m * reach_m);
        if (left > 0.0F && points_[corner.nearest].normal.dot(p.normal) > kSameSideCosine) {
          corner.weights += left * left;
          corner.weighted += left * left * p.normal.dot(offset);
        }
      });
    }
  }

  std::span<OrientedPoint const> points_;
  float spacing_m_;
  Eigen::Vector3f origin_;
  /// Corners along each axis.
  Eigen::Array3i size_ = Eigen::Array3i::Zero();
  /// From a corner to the next along each axis.
  std::array<std::size_t, 3> step_ = {};
  std::vector<Corner> corners_;
};

bool is_cut(Corner const& a, Corner const& b) {
  return (a.distance_m() < 0.0F) != (b.distance_m() < 0.0F);
}

/// The mesh under construction, and the vertex of each cell.
class Nets {
public:
  explicit Nets(DistanceGrid const& grid) : grid_(grid), vertex_of_(grid.count(), kNone) {
    for_each_cell([this](std::size_t cell, Eigen::Vector3f const& at) { add_vertex(cell, at); });
    for_each_cell([this](std::size_t cell, Eigen::Vector3f const&) { add_faces(cell); });
  }
  TriangleMesh take() { return std::move(mesh_); }

private:
  template <typename Visit>
  void for_each_cell(Visit const& visit) {
    Eigen::Array3i const& size = grid_.size();
    for (int z = 0; z + 1 < size.z(); ++z) {
      for (int y = 0; y + 1 < size.y(); ++y) {
        for (int x = 0; x + 1 < size.x(); ++x) {
          visit(grid_.index(x, y, z), Eigen::Vector3i(x, y, z).cast<float>());
        }
      }
    }
  }

  void add_vertex(std::size_t cell, Eigen::Vector3f const& at) {
    for (std::size_t k = 0; k < 8; ++k) {
      if (!grid_[grid_.corner_of(cell, k)].is_known()) {
        return;
      }
    }
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float cuts = 0.0F;
    for (std::size_t k = 0; k < 8; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::size_t const bit = std::size_t{1} << axis;
        if ((k & bit) != 0) {
          continue;
        }
        Corner const& a = grid_[grid_.corner_of(cell, k)];
        Corner const& b = grid_[grid_.corner_of(cell, k | bit)];
        if (is_cut(a, b)) {
          Eigen::Vector3f cut(static_cast<float>(k & 1U), static_cast<float>(k >> 1U & 1U),
                              static_cast<float>(k >> 2U & 1U));
          cut[static_cast<Eigen::Index>(axis)] +=
              a.distance_m() / (a.distance_m() - b.distance_m());
          sum += cut;
          cuts += 1.0F;
        }
      }
    }
    if (cuts == 0.0F) {
      return;
    }
    Eigen::Vector3f const vertex = grid_.position(at + sum / cuts);
    if (grid_.was_seen(vertex, cell)) {
      vertex_of_[cell] = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back(vertex);
    }
  }

  /// A face for each edge that leaves the cell's lowest corner and is cut.
  void add_faces(std::size_t cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Corner const& low = grid_[cell];
      Corner const& high = grid_[cell + grid_.step(axis)];
      if (!low.is_known() || !high.is_known() || !is_cut(low, high)) {
        continue;
      }
      std::size_t const u = grid_.step((axis + 1) % 3);
      std::size_t const v = grid_.step((axis + 2) % 3);
      // Counter-clockwise, looking down the axis.
      std::array<std::uint32_t, 4> face = {vertex_of_[cell], vertex_of_[cell - u],
                                           vertex_of_[cell - u - v], vertex_of_[cell - v]};
      if (std::ranges::find(face, kNone) != face.end()) {
        continue;
      }
      if (high.distance_m() < 0.0F) {
        std::swap(face[1], face[3]);
      }
      mesh_.triangles.push_back({face[0], face[1], face[2]});
      mesh_.triangles.push_back({face[0], face[2], face[3]});
    }
  }

  DistanceGrid const& grid_;
  std::vector<std::uint32_t> vertex_of_;
  TriangleMesh mesh_;
};

/// For each vertex one of its piece, the same for all of it.
std::vector<std::uint32_t> pieces_of(TriangleMesh const& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  auto const root = [&](std::uint32_t i) {
    while (parent[i] != i) {
      parent[i] = parent[parent[i]];
      i = parent[i];
    }
    return i;
  };
  for (auto const& [a, b, c] : mesh.triangles) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  for (std::uint32_t i = 0; i < parent.size(); ++i) {
    parent[i] = root(i);
  }
  return parent;
}

TriangleMesh without_crumbs(TriangleMesh const& mesh) {
  std::vector<std::uint32_t> const piece = pieces_of(mesh);
  std::vector<std::size_t> triangles(mesh.vertices.size(), 0);
  for (auto const& triangle : mesh.triangles) {
    ++triangles[piece[triangle[0]]];
  }
  std::size_t const largest =
      triangles.empty() ? 0 : *std::max_element(triangles.begin(), triangles.end());
  std::vector<std::uint32_t> moved_to(mesh.vertices.size(), kNone);
  TriangleMesh kept;
  for (auto triangle : mesh.triangles) {
    if (kLeastPieceShare * triangles[piece[triangle[0]]] < largest) {
      continue;
    }
    for (std::uint32_t& vertex : triangle) {
      if (moved_to[vertex] == kNone) {
        moved_to[vertex] = static_cast<std::uint32_t>(kept.vertices.size());
        kept.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = moved_to[vertex];
    }
    kept.triangles.push_back(triangle);
  }
  return kept;
}

}  // namespace

TriangleMesh surface_through(std::span<OrientedPoint const> points, float spacing_m) {
  if (points.empty()) {
    return {};
  }
  return without_crumbs(Nets(DistanceGrid(points, spacing_m)).take());
}

}  // namespace credo
