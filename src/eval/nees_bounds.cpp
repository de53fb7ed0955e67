#include "eval/nees_bounds.hpp"

#include <boost/math/distributions/chi_squared.hpp>

namespace credo {

NeesBounds nees_bounds(double degrees_of_freedom, std::size_t count) {
  constexpr double kOuterShare = 0.025;
  boost::math::chi_squared const of_sum(degrees_of_freedom);
  auto const errors = static_cast<double>(count);
  return {boost::math::quantile(of_sum, kOuterShare) / errors,
          boost::math::quantile(of_sum, 1.0 - kOuterShare) / errors};
}

}  // namespace credo
