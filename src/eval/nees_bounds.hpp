#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "core/se3.hpp"

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

/// The same of errors that repeat each other: their mean is known as well as that of fewer.
/// `count`, which need not be whole, is of these.
[[nodiscard]] NeesBounds nees_bounds_of(double degrees_of_freedom_each, double count);

/// How many independent claims the poses of objects over frames are worth.
///
/// Of a thing that stands still, the errors of an optimal filter at two frames have the later
/// frame's covariance in common, so the squared errors e' P^-1 e have a covariance of
/// 2 tr(P_earlier^-1 P_later): all of it while nothing is learnt, the less the more is learnt in
/// between. What covariances that grow again leave is taken for all of it.
class RepeatedClaims {
public:
  /// One more claim about an object, with 5 or 6 degrees of freedom; in the order of frames.
  /// `covariance` is positive definite.
  void add(std::string const& object, Matrix6d const& covariance, int degrees_of_freedom);

  /// As many independent claims have a mean that scatters as much (Satterthwaite). 0 without any.
  [[nodiscard]] double worth() const;

private:
  struct Earlier {
    Matrix6d information = Matrix6d::Zero();
    double claims = 0.0;
  };
  std::map<std::string, Earlier> earlier_;
  double claims_ = 0.0;
  double degrees_of_freedom_ = 0.0;
  /// Half the variance of the sum of all squared errors.
  double scatter_ = 0.0;
};

}  // namespace credo
