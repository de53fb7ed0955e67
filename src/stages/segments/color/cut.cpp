#include "stages/segments/color/cut.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "core/grid.hpp"
#include "stages/segments/color/modes.hpp"

namespace credo::segments {
namespace {

/// The border is what has the other colour so near, in cells.
constexpr int kReach = 3;
/// What is on the wrong side of the plane: of all cells, and of those at the border. A short border
/// may suit a plane that cuts through one colour farther away.
constexpr double kMisplaced = 0.05;
constexpr double kMisplacedAtBorder = 0.12;
/// On each side.
constexpr std::size_t kLeastCells = 24;
constexpr std::size_t kLeastAcross = 4;
/// Across a cut a surface bends by less, over kReach to both sides. A box's edge bends by 16 at a
/// metre.
constexpr double kFlat_quanta = 1.5;

class Cutter {
public:
  explicit Cutter(std::span<ColorCell const> cells) : cells_(cells) {
    Pixel last = {std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};
    first_ = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
    for (ColorCell const& cell : cells) {
      first_ = {std::min(first_.u, cell.column), std::min(first_.v, cell.row)};
      last = {std::max(last.u, cell.column), std::max(last.v, cell.row)};
    }
    index_ = Grid<std::int32_t>(last.u - first_.u + 1, last.v - first_.v + 1, -1);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      index_[Pixel{cells[i].column - first_.u, cells[i].row - first_.v}] =
          static_cast<std::int32_t>(i);
    }
  }

  /// Between the cells whose side is 1 and those whose side is -1; 0 is neither.
  [[nodiscard]] std::optional<ColorCut> between(std::vector<int> const& sides) const {
    std::vector<std::size_t> const border = border_of(sides);
    std::optional<ColorCut> cut = fitted(border, sides);
    if (!cut || misplaced(border, sides, *cut) > kMisplacedAtBorder ||
        misplaced(all(), sides, *cut) > kMisplaced || !is_large(*cut) || !is_flat(*cut)) {
      return std::nullopt;
    }
    return cut;
  }

private:
  [[nodiscard]] std::vector<std::size_t> all() const {
    std::vector<std::size_t> result(cells_.size());
    std::iota(result.begin(), result.end(), std::size_t{0});
    return result;
  }

  /// The cell so far from another; negative where there is none.
  [[nodiscard]] std::int32_t beside(std::size_t i, int du, int dv) const {
    Pixel const p{cells_[i].column - first_.u + du, cells_[i].row - first_.v + dv};
    return index_.contains(p) ? index_[p] : -1;
  }

  [[nodiscard]] std::vector<std::size_t> border_of(std::vector<int> const& sides) const {
    auto const is_near_other = [&](std::size_t i) {
      for (int dv = -kReach; dv <= kReach; ++dv) {
        for (int du = -kReach; du <= kReach; ++du) {
          std::int32_t const other = beside(i, du, dv);
          if (other >= 0 && sides[i] * sides[static_cast<std::size_t>(other)] < 0) {
            return true;
          }
        }
      }
      return false;
    };
    std::vector<std::size_t> border;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (is_near_other(i)) {
        border.push_back(i);
      }
    }
    return border;
  }

  [[nodiscard]] Eigen::Vector3d place(std::size_t i) const {
    return {static_cast<double>(cells_[i].column), static_cast<double>(cells_[i].row),
            static_cast<double>(cells_[i].quanta)};
  }

  /// Least squares for the sides of the cells at the border, both sides counting the same. On a
  /// face by itself inverse depth says nothing beside column and row: a little is added to its
  /// spread, so that it says little there.
  [[nodiscard]] std::optional<ColorCut> fitted(std::vector<std::size_t> const& border,
                                               std::vector<int> const& sides) const {
    constexpr double kSpread = 1.0;
    auto const positive = static_cast<double>(
        std::ranges::count_if(border, [&](std::size_t i) { return sides[i] > 0; }));
    double const negative = static_cast<double>(border.size()) - positive;
    if (positive < 3.0 || negative < 3.0) {
      return std::nullopt;
    }
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t const i : border) {
      middle += place(i);
    }
    middle /= static_cast<double>(border.size());
    Eigen::Matrix4d squares = Eigen::Vector4d(1e-6, 1e-6, kSpread, 1e-6).asDiagonal();
    Eigen::Vector4d products = Eigen::Vector4d::Zero();
    for (std::size_t const i : border) {
      Eigen::Vector4d at;
      at << place(i) - middle, 1.0;
      Eigen::Vector4d const weighted = at / (sides[i] > 0 ? positive : negative);
      squares += weighted * at.transpose();
      products += weighted * sides[i];
    }
    ColorCut cut{squares.ldlt().solve(products)};
    cut.plane[3] -= cut.plane.head<3>().dot(middle);
    return cut;
  }

  [[nodiscard]] double side(std::size_t i, ColorCut const& cut) const {
    Eigen::Vector3d const at = place(i);
    return cut.side(at.x(), at.y(), at.z());
  }

  /// A share of those.
  [[nodiscard]] double misplaced(std::vector<std::size_t> const& of, std::vector<int> const& sides,
                                 ColorCut const& cut) const {
    auto const wrong =
        std::ranges::count_if(of, [&](std::size_t i) { return sides[i] * side(i, cut) < 0.0; });
    return static_cast<double>(wrong) / static_cast<double>(of.size());
  }

  [[nodiscard]] bool is_large(ColorCut const& cut) const {
    std::size_t positive = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      positive += side(i, cut) > 0.0 ? 1 : 0;
    }
    return std::min(positive, cells_.size() - positive) >= kLeastCells;
  }

  /// Where the cut runs, by the middle of its bends, where most of it has something on both sides.
  [[nodiscard]] bool is_flat(ColorCut const& cut) const {
    Eigen::Vector2d const across = cut.plane.head<2>();
    int const du = static_cast<int>(std::lround(kReach * across.x() / across.norm()));
    int const dv = static_cast<int>(std::lround(kReach * across.y() / across.norm()));
    std::size_t on_it = 0;
    std::vector<float> bends;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (std::abs(side(i, cut)) > across.norm()) {
        continue;
      }
      ++on_it;
      std::int32_t const before = beside(i, -du, -dv);
      std::int32_t const behind = beside(i, du, dv);
      if (before >= 0 && behind >= 0) {
        bends.push_back(cells_[static_cast<std::size_t>(before)].quanta +
                        cells_[static_cast<std::size_t>(behind)].quanta - 2.0F * cells_[i].quanta);
      }
    }
    if (bends.size() < kLeastAcross || 2 * bends.size() < on_it) {
      return false;
    }
    auto const middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
    std::ranges::nth_element(bends, middle);
    return std::abs(static_cast<double>(*middle)) < kFlat_quanta;
  }

  std::span<ColorCell const> cells_;
  Pixel first_;
  /// Of the cells, by column and row from the first.
  Grid<std::int32_t> index_;
};

}  // namespace

std::optional<ColorCut> color_cut(std::span<ColorCell const> cells, double apart) {
  std::optional<ColorModes> const modes = color_modes(cells, apart);
  if (!modes) {
    return std::nullopt;
  }
  Cutter const cutter(cells);
  std::vector<int> sides(cells.size());
  for (int mode = 0; mode < modes->count; ++mode) {
    std::ranges::transform(modes->of_cell, sides.begin(),
                           [&](int of) { return of < 0 ? 0 : (of == mode ? 1 : -1); });
    if (std::optional<ColorCut> cut = cutter.between(sides)) {
      return cut;
    }
  }
  return std::nullopt;
}

}  // namespace credo::segments
