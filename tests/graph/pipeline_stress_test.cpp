#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <cstdint>
#include <random>

#include "graph/fakes.hpp"
#include "graph/pipeline.hpp"
#include "graph/run_once.hpp"

namespace credo {
namespace {

using test::FakeSource;
using test::Recorder;

int one_of(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

FakeSource::At with_failures(std::uint32_t period) {
  return [period](std::int64_t index) -> SourceResult {
    if (index % period == 1) {
      return FrameFailure{FrameIndex{index}, "noise", "unreadable"};
    }
    return test::tiny_frame(index);
  };
}

// A lost wake-up or an overtaking shows only once in many runs, so many short ones, each different.
TEST(PipelineStress, ManyShortRunsGiveWhatTheSpecificationGives) {
  std::mt19937 random(11);
  for (int round = 0; round < 150; ++round) {
    GraphConfig config;
    config.threads = one_of(random, 1, 4);
    config.belief_lag = one_of(random, 1, 4);
    test::set_edges(config, one_of(random, 1, 3));
    auto const frames = one_of(random, 1, 60);
    auto const failures = with_failures(static_cast<std::uint32_t>(one_of(random, 2, 9)));
    auto const max_us = static_cast<unsigned>(one_of(random, 0, 40));

    FakeSource source(frames, failures);
    Recorder recorder;
    Workers workers(config.threads);
    run_pipeline(source, test::fake_stages(max_us), recorder.sink(max_us), config,
                 test::empty_prior(), workers, {});
    FakeSource again(frames, failures);
    Recorder expected;
    run_once(again, test::fake_stages(), expected.sink(), config, test::empty_prior(), {});
    ASSERT_EQ(recorder.lines(), expected.lines()) << "round " << round;
  }
}

TEST(PipelineStress, ManyShortRunsThatDropLoseNoCount) {
  std::mt19937 random(12);
  for (int round = 0; round < 150; ++round) {
    GraphConfig config;
    config.threads = one_of(random, 1, 4);
    config.belief_lag = one_of(random, 1, 4);
    config.belief_seen = one_of(random, 0, 1) == 0 ? BeliefSeen::kLagged : BeliefSeen::kNewest;
    test::set_edges(config, one_of(random, 1, 2), Overflow::kDropOldest);
    config.max_consecutive_failures = 1000;  // all the good ones between may be dropped
    auto const frames = one_of(random, 1, 80);
    FakeSource source(frames, with_failures(static_cast<std::uint32_t>(one_of(random, 2, 9))));
    Recorder recorder;
    Workers workers(config.threads);
    auto const max_us = static_cast<unsigned>(one_of(random, 0, 60));
    RunReport const report = run_pipeline(source, test::fake_stages(max_us), recorder.sink(max_us),
                                          config, test::empty_prior(), workers, {});
    ASSERT_EQ(recorder.indices(), test::first(frames)) << "round " << round;
    ASSERT_EQ(report.metrics.frames_out + report.metrics.failed + test::total_dropped(report),
              static_cast<std::uint64_t>(frames));
  }
}

// Without isolation a worker that waits for its own loop takes up another frame's stage, and finds
// itself inside one frame while it is still inside another.
TEST(PipelineStress, AStageThatWaitsForItsOwnLoopDoesNotWorkOnAnotherFrame) {
  static thread_local int depth = 0;
  std::atomic<int> deepest = 0;
  Stages stages = test::fake_stages();
  auto const nested = [&](Frame const& frame) {
    if (++depth > deepest) {
      deepest = depth;
    }
    tbb::parallel_for(0, 16, [&](int i) { test::dawdle(frame, static_cast<unsigned>(i), 40); });
    --depth;
  };
  stages.normals = [&, work = stages.normals](Frame const& frame) {
    nested(frame);
    return work(frame);
  };
  stages.planes = [&, work = stages.planes](Frame const& frame, NormalMap const& normals,
                                            Segmentation so_far) {
    nested(frame);
    return work(frame, normals, std::move(so_far));
  };
  GraphConfig config;
  config.threads = 4;
  config.belief_lag = 4;
  FakeSource source(80);
  Recorder recorder;
  Workers workers(config.threads);
  run_pipeline(source, stages, recorder.sink(), config, test::empty_prior(), workers, {});
  EXPECT_EQ(recorder.indices(), test::first(80));
  EXPECT_EQ(deepest, 1);
}

}  // namespace
}  // namespace credo
