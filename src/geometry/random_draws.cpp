#include "geometry/random_draws.hpp"

#include <cmath>

namespace credo {

double draw_uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 12U) + 0.5) * 0x1.0p-52;
}

double draw_normal(std::mt19937_64& random) {
  while (true) {
    double const x = 2.0 * draw_uniform(random) - 1.0;
    double const y = 2.0 * draw_uniform(random) - 1.0;
    double const squared = x * x + y * y;
    // Zero cannot be: no draw lies on an axis.
    if (squared < 1.0) {
      return x * std::sqrt(-2.0 * std::log(squared) / squared);
    }
  }
}

}  // namespace credo
