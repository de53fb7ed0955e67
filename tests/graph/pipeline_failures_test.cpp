#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "graph/fakes.hpp"
#include "graph/pipeline.hpp"
#include "graph/run_once.hpp"

namespace credo {
namespace {

using test::FakeSource;
using test::Recorder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

RunReport run(FrameSource& source, Stages const& stages, RunSink const& sink,
              GraphConfig const& config) {
  Workers workers(config.threads);
  return run_pipeline(source, stages, sink, config, test::empty_prior(), workers, {});
}

void throw_at(Frame const& frame, std::int64_t period) {
  if (number(frame.index) % period == 2) {
    throw std::runtime_error("told to fail");
  }
}

/// Fake stages of which `broken` fails on every fifth frame.
Stages stages_with_broken(std::string const& broken) {
  Stages stages = test::fake_stages(50);
  if (broken == "normals") {
    stages.normals = [work = stages.normals](Frame const& frame) {
      throw_at(frame, 5);
      return work(frame);
    };
  } else if (broken == "detection") {
    stages.detection = [work = stages.detection](Frame const& frame, NormalMap const& normals,
                                                 BeliefState const& seen) {
      throw_at(frame, 5);
      return work(frame, normals, seen);
    };
  } else if (broken == "planes" || broken == "clustering") {
    auto& stage = broken == "planes" ? stages.planes : stages.clustering;
    stage = [work = stage](Frame const& frame, NormalMap const& normals, Segmentation so_far) {
      throw_at(frame, 5);
      return work(frame, normals, std::move(so_far));
    };
  } else {
    stages.fusion = [work = stages.fusion](BeliefState belief, Segmentation const& segmentation) {
      if (number(segmentation.frame) % 5 == 2) {
        throw 42;  // NOLINT(hicpp-exception-baseclass): that is what is tested
      }
      return work(std::move(belief), segmentation);
    };
  }
  return stages;
}

class PipelineFailures : public ::testing::TestWithParam<char const*> {};

TEST_P(PipelineFailures, AStageThatThrowsCostsItsFrameOnly) {
  Stages const stages = stages_with_broken(GetParam());
  for (int const lag : {1, 2, 4}) {
    GraphConfig config;
    config.threads = 3;
    config.belief_lag = lag;
    FakeSource source(40);
    Recorder recorder;
    RunReport const report = run(source, stages, recorder.sink(), config);
    EXPECT_EQ(report.error, nullptr);
    EXPECT_EQ(report.metrics.frames_out, 32U);
    EXPECT_EQ(report.metrics.failed, 8U);
    EXPECT_THAT(report.metrics.failures, ElementsAre(Pair(GetParam(), 8U)));
    EXPECT_EQ(recorder.indices(), test::first(40));

    FakeSource again(40);
    Recorder specified;
    run_once(again, stages, specified.sink(), config, test::empty_prior(), {});
    EXPECT_EQ(recorder.lines(), specified.lines()) << "lag " << lag;
  }
}

INSTANTIATE_TEST_SUITE_P(EachStage, PipelineFailures,
                         ::testing::Values("normals", "detection", "planes", "clustering",
                                           "fusion"),
                         [](auto const& instance) { return std::string(instance.param); });

TEST(PipelineFailures, ABadFrameOfTheSourceKeepsItsNumberAndReason) {
  GraphConfig config;
  config.threads = 2;
  config.belief_lag = 1;
  FakeSource source(6, [](std::int64_t index) -> SourceResult {
    if (index == 0 || index == 3) {
      return FrameFailure{FrameIndex{index}, "truncated_image", "it ends early"};
    }
    return test::tiny_frame(index);
  });
  Recorder recorder;
  RunReport const report = run(source, test::fake_stages(), recorder.sink(), config);
  EXPECT_EQ(recorder.indices(), test::first(6));
  EXPECT_THAT(report.metrics.failures, ElementsAre(Pair("truncated_image", 2U)));
  ASSERT_EQ(recorder.lost().size(), 2U);
  EXPECT_EQ(recorder.lost()[1].index, FrameIndex{3});
  EXPECT_EQ(recorder.lost()[1].message, "it ends early");
  // Frame 1 sees the prior, frame 4 the belief that frame 3 left as it was.
  EXPECT_THAT(recorder.segmented_with(), ElementsAre(-1, 1, 2, 4));
}

TEST(PipelineFailures, TenInARowEndTheRunAtTheSameFrameWhateverTheThreads) {
  for (int const threads : {1, 2, 4}) {
    GraphConfig config;
    config.threads = threads;
    FakeSource source(1000, [](std::int64_t index) -> SourceResult {
      bool const good = index < 5 || (index >= 14 && index < 20) || index >= 31;
      return good ? SourceResult(test::tiny_frame(index))
                  : FrameFailure{FrameIndex{index}, "noise", "unreadable"};
    });
    Recorder recorder;
    RunReport const report = run(source, test::fake_stages(100), recorder.sink(), config);
    EXPECT_EQ(recorder.indices(), test::first(30));
    EXPECT_EQ(report.metrics.frames_out, 11U);
    EXPECT_EQ(report.metrics.failed, 19U);
    EXPECT_EQ(report.metrics.frames_in, 30U + test::total_dropped(report));
    EXPECT_LT(source.given(), 100);
    EXPECT_EQ(test::error_text<InputError>(report),
              "10 frames failed in a row, the last frame 29 (noise): unreadable; mend the source "
              "or raise graph.max_consecutive_failures");
  }
}

TEST(PipelineFailures, NotOneGoodFrameIsAnInputError) {
  FakeSource source(4, [](std::int64_t index) -> SourceResult {
    return FrameFailure{FrameIndex{index}, "empty_image", "no pixels"};
  });
  Recorder recorder;
  RunReport const report = run(source, test::fake_stages(), recorder.sink(), GraphConfig{});
  EXPECT_EQ(report.metrics.failed, 4U);
  EXPECT_EQ(test::error_text<InputError>(report),
            "not one good frame: of 4, the first to fail was frame 0 (empty_image): no pixels");
}

TEST(PipelineFailures, ASourceThatThrowsEndsTheRunAfterWhatItGave) {
  FakeSource source(100, [](std::int64_t index) -> SourceResult {
    if (index == 7) {
      throw InputError("the camera was unplugged");
    }
    return test::tiny_frame(index);
  });
  Recorder recorder;
  RunReport const report = run(source, test::fake_stages(50), recorder.sink(), GraphConfig{});
  EXPECT_EQ(recorder.indices(), test::first(7));
  EXPECT_EQ(report.metrics.frames_in, 7U);
  EXPECT_EQ(test::error_text<InputError>(report), "the camera was unplugged");
}

TEST(PipelineFailures, ASourceThatLeavesOutAFrameHasBrokenItsContract) {
  FakeSource source(10, [](std::int64_t index) -> SourceResult {
    return test::tiny_frame(index < 3 ? index : index + 1);
  });
  Recorder recorder;
  RunReport const report = run(source, test::fake_stages(), recorder.sink(), GraphConfig{});
  EXPECT_EQ(report.metrics.frames_out, 3U);
  EXPECT_EQ(test::error_text<std::logic_error>(report), "the source gave frame 4 where 3 was due");
}

TEST(PipelineFailures, ADeliveryThatThrowsEndsTheRunThere) {
  for (bool const while_encoding : {false, true}) {
    GraphConfig config;
    config.threads = 3;
    Recorder recorder;
    RunSink const plain = recorder.sink();
    RunSink const full_disk = {[&](FrameResult const& result) -> Delivery {
                                 bool const full = number(result.frame->index) == 12;
                                 if (full && while_encoding) {
                                   throw InputError("disk full");
                                 }
                                 return [deliver = plain.encode(result), full] {
                                   if (full) {
                                     throw InputError("disk full");
                                   }
                                   deliver();
                                 };
                               },
                               plain.lost};
    FakeSource source(1000);
    RunReport const report = run(source, test::fake_stages(50), full_disk, config);
    EXPECT_EQ(recorder.indices(), test::first(12));
    EXPECT_EQ(report.metrics.frames_out, 12U);
    EXPECT_THAT(report.metrics.failures, ElementsAre(Pair("sink", 1U)));
    EXPECT_EQ(report.metrics.frames_in,
              report.metrics.frames_out + report.metrics.failed + test::total_dropped(report));
    EXPECT_LT(source.given(), 200);
    EXPECT_EQ(test::error_text<InputError>(report), "disk full");
  }
}

class PipelineDrops
    : public ::testing::TestWithParam<std::pair<char const*, EdgeConfig EdgesConfig::*>> {};

TEST_P(PipelineDrops, AreCountedInTheirPlaces) {
  auto const [name, edge] = GetParam();
  for (int const lag : {1, 4}) {
    GraphConfig config;
    config.threads = 2;
    config.belief_lag = lag;
    // A busy machine may drop all that lies between ten failures.
    config.max_consecutive_failures = 1000;
    test::set_edges(config, 1);
    config.edges.*edge = {1, Overflow::kDropOldest};
    std::atomic<std::int64_t> given = 0;
    FakeSource source(150, [&given](std::int64_t index) -> SourceResult {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      given = index;
      if (index % 10 == 9) {
        return FrameFailure{FrameIndex{index}, "noise", "unreadable"};
      }
      return test::tiny_frame(index);
    });
    Stages stages = test::fake_stages(400);
    bool const at_the_source = edge == &EdgesConfig::capture_normals;
    stages.normals = [&, work = stages.normals](Frame const& frame) {
      // Only this edge is written by a thread that no worker holds up.
      while (at_the_source && frame.index == FrameIndex{0} && given < 30) {
        std::this_thread::yield();
      }
      return work(frame);
    };
    Recorder recorder;
    RunReport const report = run(source, stages, recorder.sink(400), config);
    EXPECT_EQ(report.error, nullptr);
    EXPECT_EQ(recorder.indices(), test::first(150));
    EXPECT_EQ(report.metrics.failed, 15U);
    EXPECT_EQ(report.metrics.frames_in, 150U);
    EXPECT_EQ(report.metrics.frames_out + report.metrics.failed + test::total_dropped(report),
              150U);
    for (auto const& [reason, count] : report.metrics.dropped) {
      EXPECT_EQ(reason, std::string(name) + "_full");
    }
    if (at_the_source) {
      // Frames 0 and one that follows were begun; of the 30 one may still wait.
      EXPECT_GT(test::total_dropped(report), 20U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    AtEachEdge, PipelineDrops,
    ::testing::Values(std::pair("capture_normals", &EdgesConfig::capture_normals),
                      std::pair("normals_detection", &EdgesConfig::normals_detection),
                      std::pair("detection_planes", &EdgesConfig::detection_planes),
                      std::pair("planes_clustering", &EdgesConfig::planes_clustering),
                      std::pair("clustering_fusion", &EdgesConfig::clustering_fusion),
                      std::pair("fusion_encoding", &EdgesConfig::fusion_encoding),
                      std::pair("encoding_sink", &EdgesConfig::encoding_sink)),
    [](auto const& instance) { return std::string(instance.param.first); });

TEST(PipelineFailures, DropsAreNoFailuresInARow) {
  GraphConfig config;
  config.threads = 1;
  config.max_consecutive_failures = 1;
  test::set_edges(config, 1, Overflow::kDropOldest);
  FakeSource source(300);
  Recorder recorder;
  RunReport const report = run(source, test::fake_stages(), recorder.sink(2000), config);
  EXPECT_EQ(report.error, nullptr);
  EXPECT_GT(test::total_dropped(report), 10U);
  EXPECT_EQ(recorder.indices(), test::first(300));
}

// A sensor that has fallen silent may speak again: the run waits for it.
TEST(PipelineFailures, SilenceIsNoFailureInARow) {
  GraphConfig config;
  config.threads = 1;
  config.max_consecutive_failures = 3;
  auto const silent_for_a_while = [](std::int64_t index) -> SourceResult {
    if (index > 0 && index < 20) {
      return FrameFailure{FrameIndex{index}, "stalled", "no frame", Loss::kSilence};
    }
    return test::tiny_frame(index);
  };
  FakeSource source(25, silent_for_a_while);
  Recorder recorder;
  RunReport const report = run(source, test::fake_stages(), recorder.sink(0), config);
  EXPECT_EQ(report.error, nullptr);
  EXPECT_EQ(report.metrics.failures.at("stalled"), 19U);
  EXPECT_EQ(report.metrics.frames_out, 6U);
}

}  // namespace
}  // namespace credo
