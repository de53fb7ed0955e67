// The same bytes at any number of threads, and from the specification that runs without a graph.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "end_to_end/known_scene.hpp"
#include "end_to_end/program.hpp"
#include "graph/read_ahead.hpp"
#include "graph/run_once.hpp"
#include "io/belief_json.hpp"
#include "io/dataset.hpp"
#include "sim/sim_source.hpp"
#include "support/paths.hpp"
#include "support/recordings.hpp"
#include "tools/scene_file.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

/// belief.jsonl as run_once gives it.
std::vector<std::string> specified_lines(
    std::unique_ptr<FrameSource> opened, int frames, PipelineConfig const& config,
    BeliefState const& prior_belief = {},
    std::shared_ptr<KnownObjects const> const& known = std::make_shared<KnownObjects>()) {
  ReadAhead source(std::move(opened), frames);
  WorldLevel const level = find_level_ahead(source, config.pose);
  auto const prior = std::make_shared<BeliefState const>(prior_belief);
  std::vector<std::string> lines;
  RunSink const sink = {[&](FrameResult const& result) -> Delivery {
                          return [&lines, result] {
                            lines.push_back(belief_json(summary_of(*result.belief)));
                          };
                        },
                        [](FrameFailure const&) {}};
  run_once(source, make_stages(config, level, {}, known), sink, config.graph, prior, {});
  return lines;
}

void expect_same_at_any_thread_count(std::string const& source, int frames,
                                     std::vector<std::string> const& expected,
                                     std::vector<std::string> const& more = {}) {
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(frames));
  for (int const threads : {1, 2, 4}) {
    test::TempFolder const folder;
    std::vector<std::string> arguments = {"run",
                                          "--source",
                                          source,
                                          "--frames",
                                          std::to_string(frames),
                                          "--out",
                                          folder.path().string(),
                                          "--set",
                                          "graph.threads=" + std::to_string(threads)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    test::Ended const ended = test::credo(arguments);
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(test::read_lines(folder / "belief.jsonl"), expected) << threads << " threads";
  }
}

TEST(Determinism, SimulatedRooms) {
  for (char const* const name : {"first-light", "wall-and-floor", "table-before-wall"}) {
    auto source = std::make_unique<SimSource>(load_scene(name), PoseConfig{});
    int const frames = std::min(6, static_cast<int>(source->frame_count()));
    expect_same_at_any_thread_count(std::string("sim:") + name, frames,
                                    specified_lines(std::move(source), frames, {}));
  }
}

TEST(Determinism, KnownObjectsAndANoisyDetector) {
  for (char const* const name : {"box-on-table", "bottle-moves"}) {
    test::KnownScene const known = test::known_scene(name);
    SimDetectorConfig detector;
    detector.miss_probability = 0.2;
    detector.false_alarms_per_frame = 1.0;
    detector.seed = 7;
    auto source = std::make_unique<SimSource>(known.scene, PoseConfig{});
    int const frames = static_cast<int>(source->frame_count());
    expect_same_at_any_thread_count(
        std::string("sim:") + name, frames,
        specified_lines(std::move(source), frames, {}, known.prior,
                        test::known_objects(known, detector)),
        {"--prior", test::source_folder().string() + "/scenes/priors/" + name + ".yaml", "--set",
         "detector.kind=sim", "--set", "detector.sim.miss_probability=0.2", "--set",
         "detector.sim.false_alarms_per_frame=1", "--set", "detector.sim.seed=7"});
  }
}

// People who walk, meshes, and two hundred things.
TEST(Determinism, ScenesThatMoveAndScenesThatAreFull) {
  for (char const* const name : {"corridor-loop", "room-of-200"}) {
    constexpr int kFrames = 2;
    auto source = std::make_unique<SimSource>(load_scene(name), PoseConfig{});
    expect_same_at_any_thread_count(std::string("sim:") + name, kFrames,
                                    specified_lines(std::move(source), kFrames, {}));
  }
}

TEST(Determinism, FramesOfTheKitchen) {
  CREDO_REQUIRE_RECORDING("kitchen");
  fs::path const folder = test::recordings() / "kitchen";
  constexpr int kFrames = 12;
  OpenedSource opened = open_dataset(folder, {}, {});
  expect_same_at_any_thread_count("dataset:" + folder.string(), kFrames,
                                  specified_lines(std::move(opened.source), kFrames, {}));
}

}  // namespace
}  // namespace credo
