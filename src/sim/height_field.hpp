#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/grid.hpp"
#include "core/object_model.hpp"

namespace credo {

/// Side of a cell of a height field.
inline constexpr double kHeightCell_m = 0.002;

/// A turned body from above and from below: heights over its lowest point, at the middles of cells.
/// NaN where no part of it is.
struct Footprint {
  Grid<float> low_m;
  Grid<float> high_m;
  /// Where the body's origin is from the middle of the first cell.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
};

/// Of a mesh that is turned already.
[[nodiscard]] Footprint footprint_of(TriangleMesh const& mesh);

/// A place of a footprint on a field: of its first cell, and how far its lowest point is up.
struct Drop {
  Pixel cell;
  double height_m = 0.0;
};

/// What lies on a table, seen from above: the height in each cell, 0 on the table itself. Things
/// come down on it; nothing reaches below what overhangs.
class HeightField {
public:
  HeightField(int width, int depth) : heights_m_(width, depth, 0.0F) {}

  [[nodiscard]] int width() const { return heights_m_.width(); }
  [[nodiscard]] int depth() const { return heights_m_.height(); }
  /// Lets a body down at a cell until it touches; none where it would reach over the edge. It keeps
  /// off sideways by up to two cells: between the middles of cells nobody looks.
  [[nodiscard]] std::optional<Drop> drop(Footprint const& body, Pixel cell) const;
  /// Where a body that came down so touches, to a tolerance: middles of cells from the middle of
  /// the field's first one.
  [[nodiscard]] std::vector<Eigen::Vector2d> contacts(Footprint const& body, Drop const& drop,
                                                      double tolerance_m) const;
  void add(Footprint const& body, Drop const& drop);

private:
  Grid<float> heights_m_;
};

}  // namespace credo
