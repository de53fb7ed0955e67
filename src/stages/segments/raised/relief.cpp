#include "stages/segments/raised/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "stages/segments/labelled_rows.hpp"
#include "stages/segments/raised/flat_surface.hpp"
#include "stages/segments/raised/relief_kernels.hpp"

namespace credo::segments {
namespace {

/// Of the surfaces that things lie on, at the reference focal length.
constexpr double kSurface_px = 8000.0;
/// What stands out does so by so many times the noise of a mean of nine pixels.
constexpr double kNoises = 5.0;
/// Far below or above is no height of a thing that lies there, but of another.
constexpr float kFar = 4.0F;
/// What kernels read and write beyond a row.
constexpr std::size_t kMargin_px = 16;

/// SumsRow's.
struct RowSums {
  explicit RowSums(std::size_t width)
      : surface(width + kMargin_px), sums(width + kMargin_px), counts(width + kMargin_px) {}
  [[nodiscard]] SumsRow view() const { return {surface.data(), sums.data(), counts.data()}; }

  std::vector<std::int32_t> surface;
  std::vector<float> sums;
  std::vector<float> counts;
};

class Relief {
public:
  Relief(Segments const& segments, Grid<float> const& depth_m, double focal_px,
         SegmentsConfig const& config)
      : depth_m_(depth_m),
        per_px_(1.0 / std::max(depth_m.width(), 1)),
        quantum_per_m_(config.quantum_per_m),
        raised_quanta_(config.raised_quanta),
        rows_(segments.labels),
        surfaces_(flat_surfaces(segments, rows_, depth_m, config.quantum_per_m,
                                kSurface_px * std::pow(focal_px / kReferenceFocal_px, 2))),
        run_heights_(static_cast<std::size_t>(depth_m.width()) + 2 * kMargin_px) {}

  [[nodiscard]] PaddedGrid<float> heights() && {
    int const height = depth_m_.height();
    auto const width = static_cast<std::size_t>(depth_m_.width());
    PaddedGrid<float> result(depth_m_.width(), height, PaddedGrid<float>::kFewMarginRows);
    // The rows before the first and behind the last have nothing.
    std::array<RowSums, 3> rows = {RowSums(width), RowSums(width), RowSums(width)};
    for (int v = 0; v <= height; ++v) {
      RowSums& below = rows[static_cast<std::size_t>(v % 3)];
      if (v < height) {
        fill(v, below);
      } else {
        std::ranges::fill(below.surface, 0);
      }
      if (v > 0) {
        mean_row(rows[static_cast<std::size_t>((v + 1) % 3)].view(),
                 rows[static_cast<std::size_t>((v + 2) % 3)].view(), below.view(), width,
                 result.row(v - 1));
        result.end_row(v - 1);
      }
    }
    return result;
  }

private:
  /// Run by run from the left: what a kernel writes beyond one is in none or overwritten.
  void fill(int v, RowSums& row) {
    float* const heights = run_heights_.data() + 1;
    for (LabelRun const& run : rows_.row(v)) {
      auto const& surface = surfaces_[static_cast<std::size_t>(run.label)];
      auto const begin = static_cast<std::size_t>(run.begin);
      auto const end = static_cast<std::size_t>(run.end);
      std::size_t const n = end - begin;
      std::fill_n(row.surface.begin() + static_cast<std::ptrdiff_t>(begin), n,
                  surface ? run.label : 0);
      if (!surface) {
        continue;
      }
      height_row(depth_m_.row(v).data() + begin, along_row(*surface, v, begin), n, heights);
      heights[n] = 0.0F;
      sum_row(heights, n, row.sums.data() + begin);
      std::fill_n(row.counts.begin() + static_cast<std::ptrdiff_t>(begin), n, 3.0F);
      row.counts[begin] -= 1.0F;
      row.counts[end - 1] -= 1.0F;
    }
  }

  /// From column `begin` on.
  [[nodiscard]] SurfaceRow along_row(FlatSurface const& surface, int v, std::size_t begin) const {
    auto const& c = surface.coefficients;
    double const y = across(v, depth_m_.height(), per_px_);
    return {
        static_cast<float>(c[0] + y * (c[2] + y * c[5])),
        static_cast<float>(c[1] + y * c[4]),
        static_cast<float>(c[3]),
        static_cast<float>(across(static_cast<int>(begin), depth_m_.width(), per_px_)),
        static_cast<float>(per_px_),
        static_cast<float>(1.0 / quantum_per_m_),
        static_cast<float>(1.0 / std::max(raised_quanta_, kNoises * surface.rms_quanta / 3.0)),
        kFar,
    };
  }

  Grid<float> const& depth_m_;
  double per_px_;
  double quantum_per_m_;
  double raised_quanta_;
  LabelledRows rows_;
  /// By label.
  std::vector<std::optional<FlatSurface>> surfaces_;
  /// Of one run, between a 0 to each side.
  std::vector<float> run_heights_;
};

}  // namespace

PaddedGrid<float> relief(Segments const& segments, Grid<float> const& depth_m, double focal_px,
                         SegmentsConfig const& config) {
  return Relief(segments, depth_m, focal_px, config).heights();
}

}  // namespace credo::segments
