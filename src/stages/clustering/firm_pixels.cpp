#include "stages/clustering/firm_pixels.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace credo {
namespace {

bool is_firm(Grid<float> const& depth_m, LabelMap const& labels, Pixel p) {
  constexpr int kEnough = 3;
  LabelCode const label = labels[p];
  float const z_m = depth_m[p];
  int with = 0;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      Pixel const q{p.u + du, p.v + dv};
      // |1/z - 1/z'| without a division.
      bool const near = labels.contains(q) && !(q == p) && labels[q] == label &&
                        std::abs(z_m - depth_m[q]) < kFirm_per_m * z_m * depth_m[q];
      with += near ? 1 : 0;
      if (with == kEnough) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

Grid<std::uint8_t> firm_pixels(Grid<float> const& depth_m, LabelMap const& labels) {
  Grid<std::uint8_t> firm(labels.width(), labels.height());
  std::vector<std::uint8_t> has_firm(kMaxStuff, 0);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (is_stuff(labels[i]) && is_firm(depth_m, labels, labels.pixel(i))) {
      firm[i] = 1;
      has_firm[labels[i] - std::size_t{kFirstStuff}] = 1;
    }
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (is_stuff(labels[i]) && has_firm[labels[i] - std::size_t{kFirstStuff}] == 0) {
      firm[i] = 1;
    }
  }
  return firm;
}

}  // namespace credo
