// What a frame costs in the default preset: normals, segments, floor and walls, stuff, and their
// sum. Kitchen frames and table tops (OSD), one thread. Each frame runs several times, of which the
// median counts; `ms` figures are the medians over the frames of CPU time, `sum` that of the
// frames' own sums. CREDO_DATA names the folder of recordings.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cpu_time.hpp"
#include "io/dataset.hpp"
#include "stages/capture/level.hpp"
#include "stages/clustering/clustering.hpp"
#include "stages/normals/normals.hpp"
#include "stages/planes/planes.hpp"
#include "stages/segments/things.hpp"

namespace credo {
namespace {

/// A frame, and the level it is seen with.
struct Scene {
  FramePtr frame;
  WorldLevel level;
};

enum Stage : std::size_t { kNormals, kSegments, kPlanes, kClustering, kSum, kStages };
constexpr std::array<char const*, kStages> kNames = {"normals_ms", "segments_ms", "planes_ms",
                                                     "clustering_ms", "sum_ms"};

std::vector<FramePtr> read_frames(std::string const& recording) {
  char const* given = std::getenv("CREDO_DATA");  // NOLINT(concurrency-mt-unsafe): before threads
  std::filesystem::path const data = given != nullptr ? given : CREDO_DATA_DIR;
  OpenedSource const opened = open_dataset(data / recording, CaptureConfig{}, PoseConfig{});
  std::vector<FramePtr> frames;
  for (SourceResult next = opened.source->next(); !std::holds_alternative<EndOfSource>(next);
       next = opened.source->next()) {
    frames.push_back(std::get<FramePtr>(next));
  }
  return frames;
}

/// One walk through a room: all frames have the level of the first ones.
std::vector<Scene> kitchen() {
  constexpr std::size_t kEvery = 20;
  constexpr std::size_t kLevelFrames = 30;
  std::vector<FramePtr> const frames = read_frames("kitchen");
  WorldLevel const level = find_level(std::span(frames).first(kLevelFrames), PoseConfig{});
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < frames.size(); i += kEvery) {
    scenes.push_back({frames[i], level});
  }
  return scenes;
}

/// Each frame is a scene of its own.
std::vector<Scene> osd() {
  std::vector<Scene> scenes;
  for (FramePtr const& frame : read_frames("osd")) {
    scenes.push_back({frame, find_level({&frame, 1}, PoseConfig{})});
  }
  return scenes;
}

using Times = std::array<double, kStages>;

Times run(Scene const& scene) {
  Frame const& frame = *scene.frame;
  Segmentation segmentation = unassigned_segmentation(
      frame, scene.level.T_world_source * frame.T_source_camera, kPriorFrame);
  segmentation.floor_at_zero = scene.level.floor_found;
  std::array<double, kStages> ends_ms{thread_cpu_ms()};
  NormalMap const normals = estimate_normals(frame.cloud_camera, frame.intrinsics, {});
  ends_ms[1] = thread_cpu_ms();
  std::optional<Eigen::Vector3d> up_camera;
  if (scene.level.floor_found) {
    up_camera = segmentation.T_world_camera.rotation().inverse() * Eigen::Vector3d::UnitZ();
  }
  segmentation.segments = segment_things(frame, up_camera, {});
  ends_ms[2] = thread_cpu_ms();
  segmentation = extract_planes(frame, normals, std::move(segmentation), {});
  ends_ms[3] = thread_cpu_ms();
  segmentation = cluster_stuff(frame, normals, std::move(segmentation), {});
  ends_ms[4] = thread_cpu_ms();
  benchmark::DoNotOptimize(segmentation);
  Times times_ms{};
  for (std::size_t stage = 0; stage < kSum; ++stage) {
    times_ms[stage] = ends_ms[stage + 1] - ends_ms[stage];
  }
  times_ms[kSum] = ends_ms[4] - ends_ms[0];
  return times_ms;
}

void stages(benchmark::State& state, std::vector<Scene> (*read)()) {
  constexpr int kRuns = 15;
  std::vector<Scene> const scenes = read();
  tbb::global_control const one_thread(tbb::global_control::max_allowed_parallelism, 1);
  // As the program does: freed memory stays with the process.
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  std::array<std::vector<double>, kStages> medians_ms;
  for (auto step : state) {
    for (Scene const& scene : scenes) {
      std::array<std::vector<double>, kStages> runs_ms;
      for (int k = 0; k < kRuns; ++k) {
        Times const times_ms = run(scene);
        for (std::size_t stage = 0; stage < kStages; ++stage) {
          runs_ms.at(stage).push_back(times_ms.at(stage));
        }
      }
      for (std::size_t stage = 0; stage < kStages; ++stage) {
        medians_ms.at(stage).push_back(median(runs_ms.at(stage)));
      }
    }
  }
  for (std::size_t stage = 0; stage < kStages; ++stage) {
    state.counters[kNames.at(stage)] = median(medians_ms.at(stage));
  }
  state.counters["sum_ms_max"] = *std::ranges::max_element(medians_ms[kSum]);
}

BENCHMARK_CAPTURE(stages, kitchen, kitchen)->Iterations(1);
BENCHMARK_CAPTURE(stages, osd, osd)->Iterations(1);

}  // namespace
}  // namespace credo
