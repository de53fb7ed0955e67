#include "eval/nees_bounds.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>

namespace credo {

namespace {

NeesBounds bounds_of(double degrees_of_freedom, double errors) {
  constexpr double kOuterShare = 0.025;
  boost::math::chi_squared const of_sum(degrees_of_freedom);
  return {boost::math::quantile(of_sum, kOuterShare) / errors,
          boost::math::quantile(of_sum, 1.0 - kOuterShare) / errors};
}

}  // namespace

NeesBounds nees_bounds(double degrees_of_freedom, std::size_t count) {
  return bounds_of(degrees_of_freedom, static_cast<double>(count));
}

NeesBounds nees_bounds_of(double degrees_of_freedom_each, double count) {
  return bounds_of(degrees_of_freedom_each * count, count);
}

void RepeatedClaims::add(std::string const& object, Matrix6d const& covariance,
                         int degrees_of_freedom) {
  Earlier& earlier = earlier_[object];
  auto const freedom = static_cast<double>(degrees_of_freedom);
  // A turn about an axis of symmetry, of which nothing is ever learnt, has 1 in the trace.
  double const in_common =
      (earlier.information * covariance).trace() - (6.0 - freedom) * earlier.claims;
  scatter_ += freedom + 2.0 * std::clamp(in_common, 0.0, freedom * earlier.claims);
  earlier.information += covariance.llt().solve(Matrix6d::Identity());
  earlier.claims += 1.0;
  claims_ += 1.0;
  degrees_of_freedom_ += freedom;
}

double RepeatedClaims::worth() const {
  // The mean has degrees_of_freedom_ / claims_ and half the variance scatter_ / claims_^2; that of
  // n claims with as many degrees of freedom has that / n.
  return scatter_ > 0.0 ? degrees_of_freedom_ * claims_ / scatter_ : 0.0;
}

}  // namespace credo
