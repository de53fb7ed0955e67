// The kernel against a plain loop, on every instruction set of this machine.
#include "stages/segments/convexity/disc_sums.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>
#include <vector>

#include "stages/segments/convexity/limits.hpp"
#include "stages/segments/padded_grid.hpp"

namespace credo::segments {
namespace {

constexpr int kSize = 2 * kMaxDisc_px + 1;

struct LabelledHeights {
  PaddedGrid<std::int32_t> labels{kSize, kSize};
  PaddedGrid<std::int16_t> disparity{kSize, kSize};

  [[nodiscard]] DiscCentre middle() const {
    return {labels.row(kMaxDisc_px) + kMaxDisc_px, disparity.row(kMaxDisc_px) + kMaxDisc_px,
            labels.stride()};
  }
};

/// Of labels from 1 on, so many.
LabelledHeights drawn(int labels, int least_disparity) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> label(1, labels);
  std::uniform_int_distribution<int> disparity(least_disparity, 32000);
  LabelledHeights result;
  for (int v = 0; v < kSize; ++v) {
    for (int u = 0; u < kSize; ++u) {
      result.labels.row(v)[u] = label(random);
      result.disparity.row(v)[u] = static_cast<std::int16_t>(disparity(random));
    }
  }
  return result;
}

/// The whole, or what is left of it in the image's upper left corner, where nothing cancels out.
std::vector<DiscRow> disc(int radius, bool in_corner) {
  std::vector<DiscRow> rows;
  for (int v = -radius; v <= radius; v += 2) {
    int const half = static_cast<int>(std::sqrt(radius * radius - v * v));
    if (!in_corner || v >= 0) {
      rows.push_back({v, in_corner ? half % 2 : -half, half});
    }
  }
  return rows;
}

DiscSums plain_sums(DiscCentre const& centre, std::vector<DiscRow> const& rows,
                    std::int32_t label) {
  DiscSums sums;
  for (DiscRow const& row : rows) {
    for (int u = row.first_u; u <= row.last_u; u += 2) {
      std::ptrdiff_t const at = row.v * centre.stride + u;
      if (centre.label[at] == label) {
        std::int64_t const d = centre.disparity[at];
        std::int64_t const v = row.v;
        ++sums.n;
        sums.u += u;
        sums.v += v;
        sums.d += d;
        sums.uu += std::int64_t{u} * u;
        sums.uv += u * v;
        sums.vv += v * v;
        sums.ud += u * d;
        sums.vd += v * d;
        sums.dd += d * d;
      }
    }
  }
  return sums;
}

void expect_plain(LabelledHeights const& image) {
  for (int const radius : {1, 2, 4, 12, 13, 31, 50, 180, 181, kMaxDisc_px}) {
    SCOPED_TRACE(radius);
    for (bool const in_corner : {false, true}) {
      std::vector<DiscRow> const rows = disc(radius, in_corner);
      TwoSums const sums = disc_sums(image.middle(), rows, 1, 2);
      EXPECT_EQ(sums.a, plain_sums(image.middle(), rows, 1));
      EXPECT_EQ(sums.b, plain_sums(image.middle(), rows, 2));
    }
  }
}

TEST(DiscSums, AreThoseOfAPlainLoop) {
  LabelledHeights const mixed = drawn(3, 0);
  // The largest sums that there are, about.
  LabelledHeights const nearest = drawn(1, 31990);
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    expect_plain(mixed);
    expect_plain(nearest);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace credo::segments
