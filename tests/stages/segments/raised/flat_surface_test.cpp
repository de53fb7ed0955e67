#include "stages/segments/raised/flat_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace credo::segments {
namespace {

using Samples = std::vector<SurfaceSample>;

/// Of a bent surface with noise; a part of them is anywhere.
Samples random_samples(std::size_t count, unsigned seed, double astray) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.6);
  Samples samples;
  for (std::size_t i = 0; i < count; ++i) {
    double const u = share(random) - 0.5;
    double const v = 0.75 * (share(random) - 0.5);
    double const on_it = 300.0 + 80.0 * u - 45.0 * v + 3.0 * u * u - 2.0 * u * v + noise(random);
    samples.push_back({u, v, share(random) < astray ? 600.0 * share(random) : on_it});
  }
  return samples;
}

/// Every product of every sample.
FlatSurface literal_fit(Samples const& samples, FlatSurface const& so_far, int terms) {
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

std::size_t literal_on(FlatSurface const& surface, Samples const& samples, std::size_t every) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); i += every) {
    count += surface.has(samples[i]) ? 1 : 0;
  }
  return count;
}

/// The plane through three samples that most of every third are on, of sixty.
FlatSurface literal_best_plane(Samples const& samples) {
  FlatSurface best;
  std::size_t most = 0;
  for (int k = 1; k <= 60; ++k) {
    auto const pick = [&](double step) {
      double const at = k * step;
      return samples[static_cast<std::size_t>((at - std::floor(at)) *
                                              static_cast<double>(samples.size()))];
    };
    SurfaceSample const a = pick(0.8191725133961645);
    SurfaceSample const b = pick(0.6710436067037893);
    SurfaceSample const c = pick(0.5497004779019703);
    double const area = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
    double const per_u =
        ((b.quanta - a.quanta) * (c.v - a.v) - (c.quanta - a.quanta) * (b.v - a.v)) / area;
    double const per_v =
        ((b.u - a.u) * (c.quanta - a.quanta) - (c.u - a.u) * (b.quanta - a.quanta)) / area;
    FlatSurface plane;
    plane.coefficients.head<3>() << a.quanta - per_u * a.u - per_v * a.v, per_u, per_v;
    std::size_t const count = literal_on(plane, samples, 3);
    if (std::abs(area) >= 1e-4 && count > most) {
      most = count;
      best = plane;
    }
  }
  return best;
}

std::optional<FlatSurface> literal_flat_surface(Samples const& samples) {
  FlatSurface best = literal_best_plane(samples);
  for (int const terms : {3, 3, 6, 6}) {
    best = literal_fit(samples, best, terms);
  }
  bool const is_flat = 2 * literal_on(best, samples, 1) >= samples.size();
  return is_flat ? std::optional(best) : std::nullopt;
}

TEST(FlatSurface, IsTheLiteralOneToTheLastBit) {
  int found = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::size_t const count = seed <= 4 ? seed : 50 + 37 * std::size_t{seed};
    Samples const samples = random_samples(count, seed, 0.02 * seed);
    auto const fast = flat_surface(samples);
    auto const literal = literal_flat_surface(samples);
    ASSERT_EQ(fast.has_value(), literal.has_value()) << seed;
    if (fast) {
      ++found;
      EXPECT_EQ(fast->coefficients, literal->coefficients) << seed;
      EXPECT_EQ(fast->rms_quanta, literal->rms_quanta) << seed;
    }
  }
  EXPECT_GT(found, 15);
  EXPECT_LT(found, 40);
}

}  // namespace
}  // namespace credo::segments
