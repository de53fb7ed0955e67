#pragma once

#include <cmath>

namespace credo {

/// To so many decimals, and never -0: for numbers that people read.
inline double rounded(double value, int decimals) {
  double const scale = std::pow(10.0, decimals);
  return std::round(scale * value) / scale + 0.0;
}

}  // namespace credo
