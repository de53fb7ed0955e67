#pragma once

#include <cstddef>

namespace credo {

/// Where the mean of normalised squared errors lies in 95 of 100 experiments if the claims are
/// right and the errors independent.
struct NeesBounds {
  double low = 0.0;
  double high = 0.0;
};

/// Of the mean of `count` errors, at least one, with so many degrees of freedom in all: their sum
/// follows a chi-square distribution (Bar-Shalom, Li and Kirubarajan 2001, 5.4.2).
[[nodiscard]] NeesBounds nees_bounds(double degrees_of_freedom, std::size_t count);

}  // namespace credo
