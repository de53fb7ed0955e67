#pragma once

namespace credo {

/// Modified Bessel functions of the first kind, scaled by exp(-x): they neither overflow nor lose
/// digits for large x.
struct ScaledBessel {
  /// exp(-x) I0(x).
  double zero = 1.0;
  /// exp(-x) I1(x).
  double one = 0.0;
  /// exp(-x) (I0(x) - I1(x)), without cancellation.
  double difference = 1.0;
  /// exp(-x) I1(x) / x; a half at 0.
  double one_by_x = 0.5;
};

/// For x >= 0; power series below 20, asymptotic series above. Relative error about 1e-15.
[[nodiscard]] ScaledBessel scaled_bessel(double x);

}  // namespace credo
