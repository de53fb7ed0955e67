#include "graph/pipeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "core/error.hpp"
#include "graph/fakes.hpp"
#include "graph/run_once.hpp"

namespace credo {
namespace {

using test::FakeSource;
using test::Recorder;
using ::testing::ElementsAre;
using ::testing::Le;

struct Ran {
  Recorder recorder;
  RunReport report;
};

std::unique_ptr<Ran> run(std::int64_t frames, GraphConfig const& config,
                         Stages const& stages = test::fake_stages(), unsigned sink_us = 0) {
  auto ran = std::make_unique<Ran>();
  FakeSource source(frames);
  Workers workers(config.threads);
  ran->report = run_pipeline(source, stages, ran->recorder.sink(sink_us), config,
                             test::empty_prior(), workers, {});
  return ran;
}

std::unique_ptr<Ran> specified(std::int64_t frames, GraphConfig const& config) {
  auto ran = std::make_unique<Ran>();
  FakeSource source(frames);
  ran->report =
      run_once(source, test::fake_stages(), ran->recorder.sink(), config, test::empty_prior(), {});
  return ran;
}

TEST(RunOnce, SegmentsWithTheBeliefOfLagFramesAgo) {
  GraphConfig config;
  config.belief_lag = 2;
  EXPECT_THAT(specified(5, config)->recorder.segmented_with(), ElementsAre(-1, -1, 0, 1, 2));
  config.belief_lag = 1;
  EXPECT_THAT(specified(4, config)->recorder.segmented_with(), ElementsAre(-1, 0, 1, 2));
}

TEST(Pipeline, EveryFrameArrivesOnceAndInOrder) {
  GraphConfig config;
  config.threads = 4;
  auto const ran = run(200, config, test::fake_stages(300), 100);
  EXPECT_EQ(ran->recorder.indices(), test::first(200));
  EXPECT_EQ(ran->report.metrics.frames_in, 200U);
  EXPECT_EQ(ran->report.metrics.frames_out, 200U);
  EXPECT_EQ(ran->report.error, nullptr);
}

TEST(Pipeline, GivesWhatTheSpecificationGivesAtAnyLagThreadsAndCapacity) {
  for (int const lag : {1, 2, 3, 4}) {
    GraphConfig config;
    config.belief_lag = lag;
    auto const expected = specified(60, config);
    for (int const threads : {1, 2, 4}) {
      for (int const capacity : {1, 2, 5}) {
        config.threads = threads;
        test::set_edges(config, capacity);
        auto const ran = run(60, config, test::fake_stages(100));
        EXPECT_EQ(ran->recorder.lines(), expected->recorder.lines())
            << "lag " << lag << ", threads " << threads << ", capacity " << capacity;
      }
    }
  }
}

TEST(Pipeline, RunsASourceOfOneFrame) {
  GraphConfig config;
  config.threads = 1;
  auto const ran = run(1, config);
  EXPECT_EQ(ran->recorder.indices(), test::first(1));
  EXPECT_EQ(ran->report.error, nullptr);
}

TEST(Pipeline, NoFrameAtAllIsAnInputError) {
  auto const ran = run(0, GraphConfig{});
  EXPECT_EQ(ran->report.metrics.frames_in, 0U);
  EXPECT_EQ(test::error_text<InputError>(ran->report), "the source has no frames");
}

TEST(Pipeline, QueuesNeverHoldMoreThanTheirCapacity) {
  GraphConfig config;
  config.threads = 4;
  test::set_edges(config, 1);
  config.edges.normals_detection.capacity = 3;
  auto const ran = run(100, config, test::fake_stages(), 400);
  ASSERT_EQ(ran->report.metrics.queues.size(), 7U);
  for (auto const& [name, queue] : ran->report.metrics.queues) {
    EXPECT_LE(queue.peak, queue.capacity) << name;
    EXPECT_GE(queue.peak, 1U) << name;
    EXPECT_EQ(queue.dropped, 0U) << name;
  }
  EXPECT_EQ(ran->report.metrics.queues[1].first, "normals_detection");
  EXPECT_EQ(ran->report.metrics.queues[1].second.capacity, 3U);
}

TEST(Pipeline, ASlowSinkBoundsTheFramesInMemory) {
  GraphConfig config;
  config.threads = 2;
  test::set_edges(config, 1);
  std::atomic<int> alive = 0;
  std::atomic<int> most = 0;
  FakeSource source(200, [&](std::int64_t index) -> SourceResult {
    int const now = ++alive;
    int before = most;
    while (now > before && !most.compare_exchange_weak(before, now)) {
    }
    auto frame = std::shared_ptr<Frame>(new Frame, [&](Frame* gone) {
      --alive;
      delete gone;
    });
    frame->index = FrameIndex{index};
    frame->cloud_camera = OrganizedCloud(1, 1);
    return FramePtr(frame);
  });
  Recorder recorder;
  Workers workers(config.threads);
  run_pipeline(source, test::fake_stages(), recorder.sink(500), config, test::empty_prior(),
               workers, {});
  EXPECT_EQ(recorder.indices(), test::first(200));
  EXPECT_EQ(alive, 0);
  // One in each of 7 queues, up to 2 in each of 4 parallel stages, 1 in each of 3 serial ones, and
  // one that the reader holds.
  EXPECT_LE(most, 7 + 4 * 2 + 3 + 1);
}

TEST(Pipeline, StagesWorkOnDifferentFramesAtOnceButOnNoMoreThreadsThanAsked) {
  for (int const threads : {1, 2, 3}) {
    GraphConfig config;
    config.threads = threads;
    config.belief_lag = 4;
    test::set_edges(config, threads);
    // Each waits until as many as there should be are at work, so that no scheduler, however busy,
    // decides what is seen; and not for ever.
    auto const deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    int busy = 0;
    int most = 0;
    std::mutex mutex;
    std::condition_variable all_there;
    std::set<std::thread::id> ids;
    Stages stages = test::fake_stages();
    auto const plain = stages.normals;
    stages.normals = [&](Frame const& frame) {
      {
        std::unique_lock lock(mutex);
        ids.insert(std::this_thread::get_id());
        most = std::max(most, ++busy);
        all_there.notify_all();
        all_there.wait_until(lock, deadline, [&] { return most >= threads; });
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      {
        std::scoped_lock const lock(mutex);
        --busy;
      }
      return plain(frame);
    };
    run(60, config, stages);
    EXPECT_EQ(most, threads);
    EXPECT_THAT(ids.size(), Le(static_cast<std::size_t>(threads)));
    EXPECT_FALSE(ids.contains(std::this_thread::get_id()));
  }
}

TEST(Pipeline, ReportsTimesOfEveryStageAndMemory) {
  GraphConfig config;
  config.threads = 2;
  auto const ran = run(120, config, test::fake_stages(), 100);
  std::vector<std::string> names;
  for (auto const& [name, durations] : ran->report.metrics.stages) {
    names.push_back(name);
    EXPECT_EQ(durations.count, 120U) << name;
  }
  EXPECT_THAT(names, ElementsAre("capture", "normals", "detection", "planes", "clustering",
                                 "fusion", "encoding", "sink"));
  EXPECT_EQ(ran->report.metrics.latency.count, 120U);
  EXPECT_GT(ran->report.metrics.latency.max_ms, 0.0);
  EXPECT_GT(ran->report.metrics.wall_s, 0.0);
  EXPECT_GT(ran->report.metrics.fps, 0.0);
  EXPECT_GT(ran->report.metrics.rss_mb_at_100, 1.0);
  EXPECT_GE(ran->report.metrics.peak_rss_mb, ran->report.metrics.rss_mb_end);
}

TEST(Pipeline, AStopFinishesWhatWasAdmittedAndIsNoError) {
  for (int const threads : {1, 2, 4}) {
    std::stop_source stop;
    FakeSource source(1'000'000, [&](std::int64_t index) -> SourceResult {
      if (index == 37) {
        stop.request_stop();
      }
      return test::tiny_frame(index);
    });
    Recorder recorder;
    Workers workers(threads);
    RunReport const report =
        run_pipeline(source, test::fake_stages(100), recorder.sink(), GraphConfig{},
                     test::empty_prior(), workers, stop.get_token());
    EXPECT_EQ(recorder.indices(), test::first(38));
    EXPECT_EQ(report.metrics.frames_out, 38U);
    EXPECT_EQ(report.error, nullptr);
  }
}

TEST(Pipeline, AStopBeforeTheFirstFrameIsNoError) {
  std::stop_source stop;
  stop.request_stop();
  FakeSource source(5);
  Recorder recorder;
  Workers workers(2);
  RunReport const report = run_pipeline(source, test::fake_stages(), recorder.sink(), GraphConfig{},
                                        test::empty_prior(), workers, stop.get_token());
  EXPECT_EQ(source.given(), 0);
  EXPECT_EQ(report.metrics.frames_in, 0U);
  EXPECT_EQ(report.error, nullptr);
}

TEST(Pipeline, TheNewestBeliefIsUsedAndRecordedWhereAskedFor) {
  GraphConfig config;
  config.threads = 2;
  config.belief_seen = BeliefSeen::kNewest;
  auto const ran = run(50, config, test::fake_stages(50));
  ASSERT_EQ(ran->recorder.segmented_with().size(), 50U);
  for (std::int64_t i = 0; i < 50; ++i) {
    EXPECT_LT(ran->recorder.segmented_with()[static_cast<std::size_t>(i)], i);
  }
}

}  // namespace
}  // namespace credo
