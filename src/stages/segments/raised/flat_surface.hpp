#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/labelled_rows.hpp"

namespace credo::segments {

/// A place in the image and its inverse depth. From the image's middle; its width is 1.
struct SurfaceSample {
  double u = 0.0;
  double v = 0.0;
  double quanta = 0.0;
};

/// Where a pixel is: from the middle of so many, by so much a pixel.
[[nodiscard]] inline double across(int at, int size, double per_px) {
  return (at - 0.5 * (size - 1)) * per_px;
}

/// Inverse depth of a surface that is flat, or bent a little as sensors bend it.
struct FlatSurface {
  /// Of 1, u, v, u^2, u v, v^2 (SurfaceSample).
  Eigen::Matrix<double, 6, 1> coefficients = Eigen::Matrix<double, 6, 1>::Zero();
  /// Of the samples on it.
  double rms_quanta = 0.0;

  [[nodiscard]] double quanta(double u, double v) const {
    auto const& c = coefficients;
    return c[0] + u * (c[1] + u * c[3] + v * c[4]) + v * (c[2] + v * c[5]);
  }
  /// What is on it is nearer than that.
  static constexpr double kOn_quanta = 2.0;
  [[nodiscard]] bool has(SurfaceSample const& s) const {
    return std::abs(s.quanta - quanta(s.u, s.v)) < kOn_quanta;
  }
};

/// The flat surface that at least half of the samples are on; none where there is no such. Which
/// planes are tried follows a fixed sequence: the same samples give the same surface.
[[nodiscard]] std::optional<FlatSurface> flat_surface(std::vector<SurfaceSample> const& samples);

/// Of each segment of at least so many pixels its flat surface, by label; the first belongs to
/// none.
/// `rows` are those of the segments' labels.
[[nodiscard]] std::vector<std::optional<FlatSurface>> flat_surfaces(Segments const& segments,
                                                                    LabelledRows const& rows,
                                                                    Grid<float> const& depth_m,
                                                                    double quantum_per_m,
                                                                    double least_px);

}  // namespace credo::segments
