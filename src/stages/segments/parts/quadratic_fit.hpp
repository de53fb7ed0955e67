#pragma once

#include <array>
#include <span>

namespace credo::segments {

/// The quadratic in u and v that fits values at pixels best, from sums over runs of them.
class QuadraticFit {
public:
  /// Side by side, from (u, v) on. Sums of powers are exact for pixels up to a thousand.
  void add(int u, int v, std::span<double const> values);

  /// Its second differences along both axes, added, over so many pixels. Of fewer than six pixels,
  /// or of pixels in a line, it means nothing.
  [[nodiscard]] double bend(double over_px) const;

private:
  /// By the powers of u and v.
  std::array<std::array<double, 5>, 5> moments_ = {};
  std::array<std::array<double, 3>, 3> products_ = {};
};

}  // namespace credo::segments
