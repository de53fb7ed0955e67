#include "stages/segments/raised/flat_surface.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace credo::segments {
namespace {

/// Points that a surface is fitted to, about, and planes that are tried, on a part of the points.
constexpr std::uint32_t kSamples = 700;
constexpr int kHypotheses = 60;
constexpr std::size_t kScoredEvery = 3;
/// So much of a segment must be on its surface.
constexpr double kMostlyOn = 0.5;

/// Sums over samples of several things of each, side by side, so that none waits for another.
template <std::size_t kCount, typename Of>
std::array<double, kCount> sums(std::vector<SurfaceSample> const& samples, Of const& of) {
  std::array<double, kCount> result = {};
  for (SurfaceSample const& s : samples) {
    std::array<double, kCount> const values = of(s);
    for (std::size_t i = 0; i < kCount; ++i) {
      result[i] += values[i];
    }
  }
  return result;
}

/// Least squares, of which only the lower triangle is filled.
struct NormalEquations {
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> products = Eigen::Matrix<double, 6, 1>::Zero();
};

Eigen::Matrix<double, 6, 1> solution(NormalEquations const& equations, int terms) {
  Eigen::Matrix<double, 6, 1> result = Eigen::Matrix<double, 6, 1>::Zero();
  auto const used_squares = equations.squares.topLeftCorner(terms, terms);
  result.head(terms) = used_squares.ldlt().solve(equations.products.head(terms));
  return result;
}

FlatSurface plane_of(std::vector<SurfaceSample> const& samples) {
  auto const [u, v, uu, uv, vv, q, uq, vq] = sums<8>(samples, [](SurfaceSample const& s) {
    return std::array{s.u,       s.v,      s.u * s.u,      s.u * s.v,
                      s.v * s.v, s.quanta, s.u * s.quanta, s.v * s.quanta};
  });
  NormalEquations equations;
  equations.squares.col(0).head(3) << static_cast<double>(samples.size()), u, v;
  equations.squares.col(1).segment(1, 2) << uu, uv;
  equations.squares(2, 2) = vv;
  equations.products.head(3) << q, uq, vq;
  FlatSurface surface;
  surface.coefficients = solution(equations, 3);
  return surface;
}

FlatSurface bent_surface_of(std::vector<SurfaceSample> const& samples) {
  auto const n = static_cast<double>(samples.size());
  auto const [u, v, uu, uv, vv, q, uq, vq, uuq, uvq, vvq, qq] =
      sums<12>(samples, [](SurfaceSample const& s) {
        double const a = s.u * s.u;
        double const b = s.u * s.v;
        double const c = s.v * s.v;
        return std::array{s.u,
                          s.v,
                          a,
                          b,
                          c,
                          s.quanta,
                          s.u * s.quanta,
                          s.v * s.quanta,
                          a * s.quanta,
                          b * s.quanta,
                          c * s.quanta,
                          s.quanta * s.quanta};
      });
  // Products of u and v with the squares, and of the squares with each other.
  auto const [ua, ub, uc, va, vb, vc, aa, ab, ac, bb, bc, cc] =
      sums<12>(samples, [](SurfaceSample const& s) {
        double const a = s.u * s.u;
        double const b = s.u * s.v;
        double const c = s.v * s.v;
        return std::array{s.u * a, s.u * b, s.u * c, s.v * a, s.v * b, s.v * c,
                          a * a,   a * b,   a * c,   b * b,   b * c,   c * c};
      });
  NormalEquations equations;
  equations.squares.col(0) << n, u, v, uu, uv, vv;
  equations.squares.col(1).tail(5) << uu, uv, ua, ub, uc;
  equations.squares.col(2).tail(4) << vv, va, vb, vc;
  equations.squares.col(3).tail(3) << aa, ab, ac;
  equations.squares.col(4).tail(2) << bb, bc;
  equations.squares(5, 5) = cc;
  equations.products << q, uq, vq, uuq, uvq, vvq;
  FlatSurface surface;
  surface.coefficients = solution(equations, 6);
  double const left = qq - surface.coefficients.dot(equations.products);
  surface.rms_quanta = n > 0.0 ? std::sqrt(std::max(0.0, left / n)) : 0.0;
  return surface;
}

std::vector<SurfaceSample> samples_on(FlatSurface const& surface,
                                      std::vector<SurfaceSample> const& samples) {
  std::vector<SurfaceSample> result(samples.size());
  std::size_t count = 0;
  for (SurfaceSample const& s : samples) {
    // Without a branch: which are on it is not to be foreseen.
    result[count] = s;
    count += surface.has(s) ? 1 : 0;
  }
  result.resize(count);
  return result;
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

/// The samples that planes are tried on.
class Scored {
public:
  explicit Scored(std::vector<SurfaceSample> const& samples) {
    for (std::size_t i = 0; i < samples.size(); i += kScoredEvery) {
      u_.push_back(samples[i].u);
      v_.push_back(samples[i].v);
      quanta_.push_back(samples[i].quanta);
    }
  }

  /// FlatSurface::has of a plane, for all at once so that it vectorises.
  [[nodiscard]] std::size_t on(FlatSurface const& plane) const {
    double const at_middle = plane.coefficients[0];
    double const per_u = plane.coefficients[1];
    double const per_v = plane.coefficients[2];
    std::int64_t count = 0;
    for (std::size_t i = 0; i < u_.size(); ++i) {
      double const quanta = at_middle + u_[i] * per_u + v_[i] * per_v;
      count += std::abs(quanta_[i] - quanta) < FlatSurface::kOn_quanta ? 1 : 0;
    }
    return static_cast<std::size_t>(count);
  }

private:
  std::vector<double> u_;
  std::vector<double> v_;
  std::vector<double> quanta_;
};

}  // namespace

// Points are taken by a sequence that fills the unit cube evenly (Roberts 2018).
std::optional<FlatSurface> flat_surface(std::vector<SurfaceSample> const& samples) {
  constexpr std::array<double, 3> kSteps = {0.8191725133961645, 0.6710436067037893,
                                            0.5497004779019703};
  Scored const scored(samples);
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
    if (std::size_t const count = scored.on(*plane); count > most) {
      most = count;
      best = *plane;
    }
  }
  // What is on it is looked for anew with each.
  best = plane_of(samples_on(best, samples));
  best = plane_of(samples_on(best, samples));
  best = bent_surface_of(samples_on(best, samples));
  best = bent_surface_of(samples_on(best, samples));
  bool const is_flat = static_cast<double>(samples_on(best, samples).size()) >= kMostlyOn * n;
  return is_flat ? std::optional(best) : std::nullopt;
}

std::vector<std::optional<FlatSurface>> flat_surfaces(Segments const& segments,
                                                      LabelledRows const& rows,
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
  std::vector<std::vector<Pixel>> taken(labels);
  for (int v = 0; v < depth_m.height(); ++v) {
    for (LabelRun const& run : rows.row(v)) {
      auto const label = static_cast<std::size_t>(run.label);
      if (every[label] == 0) {
        continue;
      }
      auto const end = static_cast<std::size_t>(run.end);
      std::size_t u = static_cast<std::size_t>(run.begin) + next[label] - 1;
      for (; u < end; u += every[label]) {
        taken[label].push_back({static_cast<int>(u), v});
      }
      next[label] = u - end + 1;
    }
  }
  std::vector<std::optional<FlatSurface>> surfaces(labels);
  for (std::size_t i = 1; i < labels; ++i) {
    if (taken[i].empty()) {
      continue;
    }
    // Only now, and all at once: each waits long for its depth.
    std::vector<SurfaceSample> samples(taken[i].size());
    std::ranges::transform(taken[i], samples.begin(), [&](Pixel p) {
      return SurfaceSample{across(p.u, depth_m.width(), per_px),
                           across(p.v, depth_m.height(), per_px),
                           1.0 / (static_cast<double>(depth_m[p]) * quantum_per_m)};
    });
    surfaces[i] = flat_surface(samples);
  }
  return surfaces;
}

}  // namespace credo::segments
