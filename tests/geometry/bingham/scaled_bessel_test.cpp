#include "geometry/bingham/scaled_bessel.hpp"

#include <gtest/gtest.h>

#include "support/literal_bingham.hpp"

namespace credo::test {
namespace {

TEST(ScaledBessel, IsTheMeanOverACircle) {
  for (double const x : {0.0, 1e-8, 0.3, 1.0, 5.0, 12.0, 19.99, 20.0, 21.0, 60.0, 1e3, 1e5, 1e7}) {
    ScaledBessel const bessel = scaled_bessel(x);
    LiteralBessel const literal = literal_bessel(x);
    EXPECT_NEAR(bessel.zero / literal.zero, 1.0, 1e-12) << x;
    EXPECT_NEAR(bessel.one, literal.one, 1e-12 * literal.zero) << x;
    EXPECT_NEAR(bessel.difference / literal.one_less, 1.0, 1e-12) << x;
    EXPECT_NEAR(bessel.one_by_x, x < 1e-6 ? 0.5 * (1.0 - x) : literal.one / x,
                1e-12 * bessel.one_by_x)
        << x;
  }
}

}  // namespace
}  // namespace credo::test
