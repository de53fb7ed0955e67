#include "geometry/thinning.hpp"

#include "geometry/cell_sums.hpp"

namespace credo {

PointList thin_points(std::span<Eigen::Vector3f const> points, float spacing_m) {
  CellSums cells(spacing_m);
  cells.add(points);
  PointList thinned;
  cells.append_means(0, thinned);
  return thinned;
}

PointList merged_points(PointList const& known, PointList const& added, float spacing_m) {
  CellSums cells(spacing_m);
  cells.add(known);
  std::size_t const known_cells = cells.cell_count();
  cells.add(added);
  PointList merged = known;
  cells.append_means(known_cells, merged);
  return merged;
}

}  // namespace credo
