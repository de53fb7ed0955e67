#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/se3.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// Points of one frame of reference [m] in three arrays of one length, side by side.
struct PointSpans {
  std::span<float const> x, y, z;
};

/// Sums of points over the cubes of a grid: edge `spacing_m`, aligned with the axes, a corner at
/// the origin. Points that are not finite are skipped. Beyond 2^20 cells from the origin along an
/// axis, cells are no longer told apart. Cells are numbered in the order of their first points, and
/// each adds up its points in the order in which they come: how they are cut into pieces makes no
/// difference.
class CellSums {
public:
  /// Throws std::logic_error unless the spacing is positive and finite.
  explicit CellSums(float spacing_m);
  /// Of points that are given in another frame than the grid's, and moved on the way, in floats.
  CellSums(float spacing_m, Se3 const& T_grid_points);

  void add(PointSpans const& points);
  void add(std::span<Eigen::Vector3f const> points);

  [[nodiscard]] std::size_t cell_count() const { return cells_.size() - 1; }
  /// Appends the mean point of each cell from number `first` on.
  void append_means(std::size_t first, PointList& means) const;
  /// Mean of all points added; NaN if there were none.
  [[nodiscard]] Eigen::Vector3f mean() const;
  /// Bounds of all points added; empty if there were none.
  [[nodiscard]] Eigen::AlignedBox3f bounds() const;

  static constexpr std::size_t kChunk = 64;
  static constexpr std::size_t kLanes = 8;
  static constexpr float kFirstCell = -(1 << 20);
  static constexpr float kLastCell = (1 << 20) - 1;
  /// Beyond all cells of an axis.
  static constexpr std::int32_t kNoCell = 1 << 20;
  /// Up to kChunk points.
  struct Chunk {
    /// Axis by axis.
    std::array<std::array<float, kChunk>, 3> points;
    /// Axis by axis, that of the first point in place 1.
    std::array<std::array<std::int32_t, 1 + kChunk>, 3> cells;
    /// 1 for each point whose cell is not that of the point before it, and for the first.
    std::uint64_t begins = 0;
  };
  /// How a kernel places points; bounds lane by lane.
  struct Placement {
    float cells_per_m = 0.0F;
    bool moves = false;
    // Rows of the matrix: rotation, then translation.
    std::array<std::array<float, 4>, 3> motion{};
    std::array<std::array<float, kLanes>, 3> min{};
    std::array<std::array<float, kLanes>, 3> max{};
  };

private:
  // Sums in double, so that the mean of a few hundred thousand points keeps a float's precision.
  struct Cell {
    std::uint64_t key = 0;
    double count = 0.0;
    std::array<double, 3> sum{};

    [[nodiscard]] Eigen::Vector3f mean() const;
  };

  [[nodiscard]] std::uint32_t number_of(std::uint64_t key);
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
  void grow();
  /// At most kChunk of them.
  void add_chunk(PointSpans const& points);

  Placement placement_;
  // From number 1 on; the first takes points that are in none.
  std::vector<Cell> cells_ = std::vector<Cell>(1);
  // Hash table of cells, by number; 0 is free. Small at first: a frame may hold very many
  // clusters, and each has its own.
  std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(16);
};

}  // namespace credo
