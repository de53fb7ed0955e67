#pragma once

#include <random>

namespace credo {

/// Uniform in (0, 1): the middle of one of 2^52 equal steps. Unlike those of <random>, these draws
/// are the same with every standard library.
[[nodiscard]] double draw_uniform(std::mt19937_64& random);

/// Standard normal (Marsaglia's polar method, one of each pair). It keeps no state beside the
/// generator's, so that a generator in the same state gives the same numbers.
[[nodiscard]] double draw_normal(std::mt19937_64& random);

}  // namespace credo
