#include "stages/segments/flat_surface.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/runs.hpp"

namespace credo::segments {
namespace {

/// Points that a surface is fitted to, about, and planes that are tried, on a part of the points.
constexpr std::uint32_t kSamples = 700;
constexpr int kHypotheses = 60;
constexpr std::size_t kScoredEvery = 3;
/// So much of a segment must be on its surface.
constexpr double kMostlyOn = 0.5;

/// Least squares over what is on the surface so far; `terms` 3 for a plane, 6 for a bent one.
FlatSurface fitted(std::vector<SurfaceSample> const& samples, FlatSurface const& so_far,
                   int terms) {
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> products = Eigen::Matrix<double, 6, 1>::Zero();
  double square_sum = 0.0;
  double count = 0.0;
  for (SurfaceSample const& s : samples) {
    if (so_far.has(s)) {
      Eigen::Matrix<double, 6, 1> row;
      row << 1.0, s.u, s.v, s.u * s.u, s.u * s.v, s.v * s.v;
      squares += row * row.transpose();
      products += row * s.quanta;
      square_sum += s.quanta * s.quanta;
      count += 1.0;
    }
  }
  FlatSurface surface;
  auto const used_squares = squares.topLeftCorner(terms, terms);
  surface.coefficients.head(terms) = used_squares.ldlt().solve(products.head(terms));
  double const left = square_sum - surface.coefficients.dot(products);
  surface.rms_quanta = count > 0.0 ? std::sqrt(std::max(0.0, left / count)) : 0.0;
  return surface;
}

/// The plane through three points; none where they are nearly in line.
std::optional<FlatSurface> through(SurfaceSample const& a, SurfaceSample const& b,
                                   SurfaceSample const& c) {
  double const determinant = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
  constexpr double kLeast = 1e-4;
  if (std::abs(determinant) < kLeast) {
    return std::nullopt;
  }
  double const per_u =
      ((b.quanta - a.quanta) * (c.v - a.v) - (c.quanta - a.quanta) * (b.v - a.v)) / determinant;
  double const per_v =
      ((b.u - a.u) * (c.quanta - a.quanta) - (c.u - a.u) * (b.quanta - a.quanta)) / determinant;
  FlatSurface plane;
  plane.coefficients.head<3>() << a.quanta - per_u * a.u - per_v * a.v, per_u, per_v;
  return plane;
}

std::size_t points_on(FlatSurface const& surface, std::vector<SurfaceSample> const& samples,
                      std::size_t every) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); i += every) {
    count += surface.has(samples[i]) ? 1 : 0;
  }
  return count;
}

}  // namespace

// Points are taken by a sequence that fills the unit cube evenly (Roberts 2018).
std::optional<FlatSurface> flat_surface(std::vector<SurfaceSample> const& samples) {
  constexpr std::array<double, 3> kSteps = {0.8191725133961645, 0.6710436067037893,
                                            0.5497004779019703};
  FlatSurface best;
  std::size_t most = 0;
  auto const n = static_cast<double>(samples.size());
  for (int k = 1; k <= kHypotheses; ++k) {
    auto const pick = [&](double step) -> SurfaceSample const& {
      double const at = k * step;
      return samples[static_cast<std::size_t>((at - std::floor(at)) * n)];
    };
    auto const plane = through(pick(kSteps[0]), pick(kSteps[1]), pick(kSteps[2]));
    if (!plane) {
      continue;
    }
    if (std::size_t const count = points_on(*plane, samples, kScoredEvery); count > most) {
      most = count;
      best = *plane;
    }
  }
  for (int const terms : {3, 3, 6, 6}) {
    best = fitted(samples, best, terms);
  }
  bool const is_flat = static_cast<double>(points_on(best, samples, 1)) >= kMostlyOn * n;
  return is_flat ? std::optional(best) : std::nullopt;
}

std::vector<std::optional<FlatSurface>> flat_surfaces(Segments const& segments,
                                                      Grid<float> const& depth_m,
                                                      double quantum_per_m, double least_px) {
  std::size_t const labels = segments.pixel_counts.size() + 1;
  double const per_px = 1.0 / std::max(depth_m.width(), 1);
  // Of each segment, every so many pixels one is taken; and how far the next is.
  std::vector<std::size_t> every(labels, 0);
  for (std::size_t i = 1; i < labels; ++i) {
    std::uint32_t const pixels = segments.pixel_counts[i - 1];
    every[i] = pixels < least_px ? 0 : std::max(1U, pixels / kSamples);
  }
  std::vector<std::size_t> next = every;
  std::vector<std::vector<SurfaceSample>> samples(labels);
  for (int v = 0; v < depth_m.height(); ++v) {
    std::span<std::int32_t const> const row = segments.labels.row(v);
    for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
      end = run_end(row, begin);
      auto const label = static_cast<std::size_t>(row[begin]);
      if (every[label] == 0) {
        continue;
      }
      std::size_t u = begin + next[label] - 1;
      for (; u < end; u += every[label]) {
        auto const column = static_cast<int>(u);
        samples[label].push_back(
            {across(column, depth_m.width(), per_px), across(v, depth_m.height(), per_px),
             1.0 / (static_cast<double>(depth_m[Pixel{column, v}]) * quantum_per_m)});
      }
      next[label] = u - end + 1;
    }
  }
  std::vector<std::optional<FlatSurface>> surfaces(labels);
  for (std::size_t i = 1; i < labels; ++i) {
    if (!samples[i].empty()) {
      surfaces[i] = flat_surface(samples[i]);
    }
  }
  return surfaces;
}

}  // namespace credo::segments
