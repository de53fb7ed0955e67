// The quantum is the sensor's: what it is for a stereo camera whose inverse depth is scattered
// more.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "stages/segments/segments.hpp"
#include "stages/segments/table.hpp"

namespace credo {
namespace {

/// Matching to a tenth of a pixel, over a base of 5 cm, at a focal length of 425 px; what stereo
/// gets wrong, it gets wrong in patches.
Grid<float> seen_by_stereo(Grid<float> const& depth_m) {
  constexpr double kScatter_per_m = 0.1 / (0.05 * 425.0);
  constexpr int kPatch_px = 3;
  std::mt19937 random(5);
  std::normal_distribution<double> scatter(0.0, kScatter_per_m);
  Grid<double> error(depth_m.width() / kPatch_px + 1, depth_m.height() / kPatch_px + 1);
  std::ranges::generate(error, [&] { return scatter(random); });
  Grid<float> noisy(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    Pixel const p = depth_m.pixel(i);
    double const per_m =
        1.0 / static_cast<double>(depth_m[i]) + error[Pixel{p.u / kPatch_px, p.v / kPatch_px}];
    noisy[i] = static_cast<float>(1.0 / per_m);
  }
  return noisy;
}

std::size_t large_count(Segments const& segments) {
  return static_cast<std::size_t>(
      std::ranges::count_if(segments.pixel_counts, [](std::uint32_t n) { return n > 300; }));
}

TEST(Sensors, AStereoCamerasNoiseNeedsAQuantumBetweenAKinectsAndTwiceThat) {
  test::Table table(1.4);
  table.add_box(-0.12, 0.0, 0.4, {0.07, 0.09, 0.07});
  table.add_box(0.12, 0.05, 0.1, {0.06, 0.07, 0.06});
  Grid<float> const depth_m = seen_by_stereo(table.depth_m(false));
  for (double const quantum_per_m : {0.00287, 0.004, 0.0057}) {
    SegmentsConfig config;
    config.quantum_per_m = quantum_per_m;
    Segments const segments = convex_segments(depth_m, 585.0, config);
    EXPECT_EQ(large_count(segments), 3U) << quantum_per_m;
    std::int32_t const left = test::label_at(segments, table.place(-0.12, 0.18, 0));
    std::int32_t const right = test::label_at(segments, table.place(0.12, 0.14, 0.05));
    std::int32_t const top = test::label_at(segments, table.place(0, 0, 0.2));
    EXPECT_NE(left, right) << quantum_per_m;
    EXPECT_NE(left, top) << quantum_per_m;
    EXPECT_NE(right, top) << quantum_per_m;
  }
  // With a larger one the creases at this distance are no more than noise.
  SegmentsConfig coarse;
  coarse.quantum_per_m = 0.008;
  EXPECT_LT(large_count(convex_segments(depth_m, 585.0, coarse)), 3U);
}

}  // namespace
}  // namespace credo
