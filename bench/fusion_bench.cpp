// What fusing a frame into a belief of many things costs: a wall of square tiles, each a cluster of
// its own, half of which the camera sees. The median over frames; wall-clock time, all cores.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "cpu_time.hpp"
#include "geometry/sight.hpp"
#include "stages/fusion/fusion.hpp"

namespace credo {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kFocal_px = 525.0;

/// A wall 2 m away, seen from `x_m` along it, in tiles of so many pixels that are 5 cm apart in
/// depth from their neighbours.
Segmentation tiles(int tile_px, double x_m, std::int64_t frame) {
  constexpr double kWall_m = 2.0;
  Segmentation segmentation;
  segmentation.frame = FrameIndex{frame};
  segmentation.stamp_ns = frame * 33'333'333;
  segmentation.T_world_camera = Se3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x_m, 0.0, 0.0));
  segmentation.labels = LabelMap(kWidth, kHeight, kUnassigned);
  Grid<float> depth_m(kWidth, kHeight);
  int const shift_px = static_cast<int>(std::lround(x_m * kFocal_px / kWall_m));
  int const first = shift_px / tile_px;
  int const columns = kWidth / tile_px + 2;
  int const rows = (kHeight + tile_px - 1) / tile_px;
  segmentation.stuff.resize(static_cast<std::size_t>(columns * rows));
  for (std::size_t i = 0; i < segmentation.stuff.size(); ++i) {
    segmentation.stuff[i].label = static_cast<LabelCode>(kFirstStuff + i);
  }
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      int const column = (u + shift_px) / tile_px;
      int const row = v / tile_px;
      auto const place = static_cast<std::size_t>((column - first) * rows + row);
      depth_m[{u, v}] = static_cast<float>(kWall_m + ((column + row) % 2 == 0 ? 0.0 : 0.05));
      segmentation.labels[{u, v}] = static_cast<LabelCode>(kFirstStuff + place);
      ++segmentation.stuff[place].pixel_count;
    }
  }
  segmentation.sight =
      sight_of(depth_m, segmentation.labels, {kFocal_px, kFocal_px, kWidth / 2.0, kHeight / 2.0});
  return segmentation;
}

/// The argument is how large a tile is: it tells how many things there come to be.
void fuse_tiles(benchmark::State& state) {
  auto const tile_px = static_cast<int>(state.range(0));
  constexpr int kFrames = 40;
  // There and back over twice the image's width, so that half of what is known is in view.
  constexpr double kWay_m = 2.4;
  std::vector<Segmentation> frames;
  for (int i = 0; i <= kFrames; ++i) {
    frames.push_back(tiles(tile_px, kWay_m * i / kFrames, i));
  }
  FusionConfig const config;
  std::vector<double> times_ms;
  std::size_t things = 0;
  for ([[maybe_unused]] auto const _ : state) {
    BeliefState belief;
    for (Segmentation const& frame : frames) {
      belief = fuse(std::move(belief), frame, config);
    }
    things = belief.stuff.size();
    for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame) {
      auto const before = std::chrono::steady_clock::now();
      belief = fuse(std::move(belief), *frame, config);
      times_ms.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before)
              .count());
    }
  }
  state.counters["things"] = static_cast<double>(things);
  state.counters["median_ms"] = median(times_ms);
}

BENCHMARK(fuse_tiles)->Arg(80)->Arg(24)->Iterations(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace credo
