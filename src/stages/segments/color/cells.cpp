#include "stages/segments/color/cells.hpp"

#include <cstddef>

namespace credo::segments {
namespace {

/// Mean of the three channels, of 255. With less, noise is as large as colour.
constexpr std::uint32_t kLeastLight = 30;

class Cells {
public:
  Cells(Segments const& segments, Grid<float> const& depth_m, Grid<Rgb> const& color, int side_px,
        double quantum_per_m)
      : labels_(segments.labels),
        depth_m_(depth_m),
        color_(color),
        side_px_(side_px),
        quanta_m_(static_cast<float>(1.0 / quantum_per_m)) {}

  /// 0 where they are not all the same.
  [[nodiscard]] std::int32_t label_of(int u, int v) const {
    std::int32_t const label = labels_[Pixel{u, v}];
    std::int32_t others = 0;
    for (int dv = 0; dv < side_px_; ++dv) {
      std::int32_t const* const row = &labels_[Pixel{u, v + dv}];
      for (int du = 0; du < side_px_; ++du) {
        others |= row[du] ^ label;
      }
    }
    return others == 0 ? label : 0;
  }

  [[nodiscard]] ColorCell cell(int u, int v) const {
    std::uint32_t red = 0;
    std::uint32_t green = 0;
    std::uint32_t blue = 0;
    float quanta = 0.0F;
    for (int dv = 0; dv < side_px_; ++dv) {
      Rgb const* const row = &color_[Pixel{u, v + dv}];
      float const* const depth_m = &depth_m_[Pixel{u, v + dv}];
      for (int du = 0; du < side_px_; ++du) {
        red += row[du][0];
        green += row[du][1];
        blue += row[du][2];
        quanta += quanta_m_ / depth_m[du];
      }
    }
    auto const pixels = static_cast<std::uint32_t>(side_px_ * side_px_);
    std::uint32_t const light = red + green + blue;
    ColorCell cell{u / side_px_, v / side_px_, quanta / static_cast<float>(pixels)};
    if (light >= 3 * kLeastLight * pixels) {
      cell.red = static_cast<float>(red) / static_cast<float>(light);
      cell.green = static_cast<float>(green) / static_cast<float>(light);
    }
    return cell;
  }

private:
  Grid<std::int32_t> const& labels_;
  Grid<float> const& depth_m_;
  Grid<Rgb> const& color_;
  int side_px_;
  float quanta_m_;
};

}  // namespace

std::vector<std::vector<ColorCell>> color_cells(Segments const& segments,
                                                Grid<float> const& depth_m, Grid<Rgb> const& color,
                                                int side_px, double quantum_per_m,
                                                std::vector<bool> const& wanted) {
  std::vector<std::vector<ColorCell>> cells(wanted.size());
  Cells const all(segments, depth_m, color, side_px, quantum_per_m);
  for (int v = 0; v + side_px <= color.height(); v += side_px) {
    for (int u = 0; u + side_px <= color.width(); u += side_px) {
      if (!wanted[static_cast<std::size_t>(segments.labels[Pixel{u, v}])]) {
        continue;
      }
      if (std::int32_t const label = all.label_of(u, v); label != 0) {
        cells[static_cast<std::size_t>(label)].push_back(all.cell(u, v));
      }
    }
  }
  return cells;
}

}  // namespace credo::segments
