#include "stages/segments/color/parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/runs.hpp"
#include "stages/segments/color/cells.hpp"
#include "stages/segments/color/cut.hpp"
#include "stages/segments/numbering.hpp"

namespace credo {
namespace {

using segments::ColorCell;
using segments::ColorCut;

constexpr double kCell_px = 4.0;
/// Smaller ones are not two things of sensible size.
constexpr std::size_t kLeastCells = 48;
/// What is larger, seen from before, or fills more of the image (which need not be looked at then)
/// is furniture, floor or wall.
constexpr double kLargest_m2 = 0.3;
constexpr double kLargestShare = 0.2;

class Splitter {
public:
  Splitter(Segments segments, Grid<float> const& depth_m, Grid<Rgb> const& color, double focal_px,
           SegmentsConfig const& config)
      : segments_(std::move(segments)),
        depth_m_(depth_m),
        color_(color),
        focal_px_(focal_px),
        config_(config),
        side_px_(
            std::max(1, static_cast<int>(std::lround(kCell_px * focal_px / kReferenceFocal_px)))) {}

  Segments split() && {
    std::vector<std::vector<ColorCell>> cells = segments::color_cells(
        segments_, depth_m_, color_, side_px_, config_.quantum_per_m, candidates());
    std::size_t labels = cells.size();
    for (std::size_t label = 1; label < cells.size(); ++label) {
      while (is_thing(cells[label])) {
        auto const cut = segments::color_cut(cells[label], config_.color_apart);
        if (!cut) {
          break;
        }
        take_off(label, labels++, *cut);
        // Positive is one colour; of the others there may be two.
        std::erase_if(cells[label], [&](ColorCell const& cell) {
          return cut->side(cell.column, cell.row, static_cast<double>(cell.quanta)) > 0.0;
        });
      }
    }
    if (labels > cells.size()) {
      number(labels);
    }
    return std::move(segments_);
  }

private:
  [[nodiscard]] std::vector<bool> candidates() const {
    double const most = kLargestShare * static_cast<double>(segments_.labels.size());
    double const least = static_cast<double>(kLeastCells) * side_px_ * side_px_;
    std::vector<bool> wanted = {false};
    for (std::uint32_t const pixels : segments_.pixel_counts) {
      wanted.push_back(pixels >= least && pixels <= most);
    }
    return wanted;
  }

  [[nodiscard]] bool is_thing(std::vector<ColorCell> const& cells) const {
    double const side_quanta = side_px_ / (focal_px_ * config_.quantum_per_m);
    double area_m2 = 0.0;
    for (ColorCell const& cell : cells) {
      double const side_m = side_quanta / static_cast<double>(cell.quanta);
      area_m2 += side_m * side_m;
    }
    return cells.size() >= kLeastCells && area_m2 <= kLargest_m2;
  }

  /// Gives what is on the cut's positive side a label of its own.
  void take_off(std::size_t label, std::size_t new_label, ColorCut const& cut) {
    double const middle_px = (side_px_ - 1) / 2.0;
    for (int v = 0; v < segments_.labels.height(); ++v) {
      std::span<std::int32_t> const row = segments_.labels.row(v);
      for (std::size_t u = 0; u < row.size(); ++u) {
        if (row[u] != static_cast<std::int32_t>(label)) {
          u = run_end(std::span<std::int32_t const>(row), u) - 1;
          continue;
        }
        double const z_m = static_cast<double>(depth_m_.row(v)[u]);
        if (cut.side((static_cast<double>(u) - middle_px) / side_px_, (v - middle_px) / side_px_,
                     1.0 / (config_.quantum_per_m * z_m)) > 0.0) {
          row[u] = static_cast<std::int32_t>(new_label);
        }
      }
    }
  }

  /// Anew, in raster order.
  void number(std::size_t labels) {
    std::vector<std::int32_t> root(labels);
    std::iota(root.begin(), root.end(), 0);
    segments::Numbering numbering(std::move(root));
    for (int v = 0; v < segments_.labels.height(); ++v) {
      std::span<std::int32_t> const row = segments_.labels.row(v);
      for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
        end = run_end(std::span<std::int32_t const>(row), begin);
        std::int32_t const number = numbering.number(row[begin], end - begin);
        std::ranges::fill(row.subspan(begin, end - begin), number);
      }
    }
    segments_.pixel_counts = std::move(numbering).pixel_counts();
  }

  Segments segments_;
  Grid<float> const& depth_m_;
  Grid<Rgb> const& color_;
  double focal_px_;
  SegmentsConfig const& config_;
  int side_px_;
};

}  // namespace

Segments split_by_color(Segments segments, Grid<float> const& depth_m, Grid<Rgb> const& color,
                        double focal_px, SegmentsConfig const& config) {
  if (config.color_apart <= 0.0 || !color.same_size(segments.labels)) {
    return segments;
  }
  return Splitter(std::move(segments), depth_m, color, focal_px, config).split();
}

}  // namespace credo
