// Segmentation, metrics and lifecycle, read in another process than the writer's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "belief.h"
#include "core/dds_config.hpp"
#include "core/label.hpp"
#include "dds/participant.hpp"
#include "end_to_end/program.hpp"
#include "end_to_end/topic_reader.hpp"
#include "io/image.hpp"
#include "metrics.h"
#include "segmentation.h"
#include "support/oni_writer.hpp"

namespace credo::test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StatusTopics : public ::testing::Test {
protected:
  StatusTopics() { config_.topic_prefix = "status_" + std::to_string(getpid()); }

  std::vector<std::string> run_command(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"run",
                                          "--set",
                                          "dds.topic_prefix=" + config_.topic_prefix,
                                          "--set",
                                          "dds.source=robot",
                                          "--out",
                                          (folder_ / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return credo_command(arguments);
  }

  /// Again and again for a minute at most.
  static void until(std::function<bool()> const& done) {
    for (int i = 0; i < 1200 && !done(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  DdsConfig config_;
  TempFolder folder_;
};

struct ReceivedSegmentation {
  std::uint64_t revision = 0;
  Grid<std::uint16_t> labels;
  std::map<LabelCode, std::uint64_t> pixel_counts;
};

TEST_F(StatusTopics, TheSegmentationIsTheLabelImage) {
  Participant const participant(config_);
  TopicReader<credo_msg_Segmentation> reader(participant, "segmentation",
                                             credo_msg_Segmentation_desc, Delivery::kBestEffort);
  std::map<std::int64_t, ReceivedSegmentation> received;
  Program run(run_command(
      {"--source", "sim:first-light", "--frames", "20", "--dump", "labels", "--linger", "60"}));
  std::int64_t last = -1;
  until([&] {
    reader.take([&](credo_msg_Segmentation const& sample, dds_sample_info_t const& info) {
      if (!info.valid_data) {
        return;
      }
      ReceivedSegmentation& frame = received[sample.frame];
      frame.revision = sample.revision;
      frame.labels = Grid<std::uint16_t>(
          static_cast<int>(sample.width_px), static_cast<int>(sample.height_px),
          std::vector<std::uint16_t>(sample.labels._buffer,
                                     sample.labels._buffer + sample.labels._length));
      for (std::uint32_t i = 0; i < sample.segments._length; ++i) {
        credo_msg_Segment const& segment = sample.segments._buffer[i];
        frame.pixel_counts[segment.label] = segment.pixel_count;
      }
      last = sample.frame;
      EXPECT_DOUBLE_EQ(sample.T_world_camera[15], 1.0);
      EXPECT_GT(sample.fx_px, 0.0);
    });
    return last == 19;
  });
  run.send(SIGINT);
  EXPECT_EQ(run.wait().code, 0);
  // Best effort: some may have been missed, but not all.
  ASSERT_FALSE(received.empty());
  for (auto const& [frame, segmentation] : received) {
    EXPECT_EQ(segmentation.revision, static_cast<std::uint64_t>(frame) + 1);
    std::string const name = std::to_string(1000000 + frame).substr(1) + ".png";
    EXPECT_TRUE(segmentation.labels == read_png16(folder_ / "out" / "labels" / name)) << frame;
    for (LabelCode const label : segmentation.labels) {
      ASSERT_TRUE(label <= kUnassigned || segmentation.pixel_counts.contains(label)) << label;
    }
    for (auto const& [label, count] : segmentation.pixel_counts) {
      if (is_stuff(label)) {
        EXPECT_EQ(static_cast<std::uint64_t>(std::ranges::count(segmentation.labels, label)),
                  count);
      }
    }
  }
}

TEST_F(StatusTopics, MetricsComeWhileItRunsAndAtItsEnd) {
  Participant const participant(config_);
  TopicReader<credo_msg_Metrics> reader(participant, "metrics", credo_msg_Metrics_desc,
                                        Delivery::kBestEffort);
  std::vector<std::uint64_t> frames_in;
  std::map<std::string, std::uint64_t> stages;
  std::size_t queues = 0;
  Program run(run_command({"--source", "sim:first-light", "--frames", "90", "--dump", "pictures",
                           "--set", "graph.threads=1", "--linger", "60"}));
  until([&] {
    reader.take([&](credo_msg_Metrics const& sample, dds_sample_info_t const& info) {
      if (!info.valid_data) {
        return;
      }
      frames_in.push_back(sample.frames_in);
      EXPECT_EQ(sample.frames_out, sample.frames_in);
      for (std::uint32_t i = 0; i < sample.stages._length; ++i) {
        stages[sample.stages._buffer[i].stage] = sample.stages._buffer[i].duration.count;
      }
      queues = sample.queues._length;
    });
    return !frames_in.empty() && frames_in.back() == 90;
  });
  ASSERT_GE(frames_in.size(), 2U) << "a run of seconds tells them more than once";
  EXPECT_TRUE(std::ranges::is_sorted(frames_in));
  EXPECT_EQ(frames_in.back(), 90U);
  EXPECT_EQ(stages.at("capture"), 90U);
  EXPECT_EQ(stages.at("sink"), 90U);
  EXPECT_EQ(queues, 7U);
  run.send(SIGINT);
  EXPECT_EQ(run.wait().code, 0);
}

// A recording without its end record is as silent, for OpenNI2, as a sensor that hangs.
TEST_F(StatusTopics, ASilentSensorIsToldUntilItSpeaksOrTheRunStops) {
  OniScript script;
  script.width = 64;
  script.height = 48;
  script.depth_images.assign(3, packed(std::vector<std::uint16_t>(64 * 48, 1500)));
  std::string const bytes = oni_bytes(script);
  write_text(folder_ / "a.oni", bytes.substr(0, bytes.size() - 28));
  Participant const participant(config_);
  TopicReader<credo_msg_Lifecycle> reader(participant, "lifecycle", credo_msg_Lifecycle_desc);
  std::vector<credo_msg_LifecycleState> states;
  std::string detail;
  auto const take = [&] {
    reader.take([&](credo_msg_Lifecycle const& sample, dds_sample_info_t const& info) {
      if (info.valid_data && (states.empty() || states.back() != sample.state)) {
        states.push_back(sample.state);
        detail = sample.detail;
      }
    });
  };
  Program run(run_command({"--source", "openni:" + (folder_ / "a.oni").string()}));
  until([&] {
    take();
    return !states.empty() && states.back() == credo_msg_LIFECYCLE_SOURCE_LOST;
  });
  EXPECT_THAT(detail, HasSubstr("sends no depth"));
  run.send(SIGINT);
  Ended const ended = run.wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("lost: stalled: openni:"));
  until([&] {
    take();
    return !states.empty() && states.back() == credo_msg_LIFECYCLE_STOPPING;
  });
  EXPECT_THAT(states, ElementsAre(credo_msg_LIFECYCLE_RUNNING, credo_msg_LIFECYCLE_SOURCE_LOST,
                                  credo_msg_LIFECYCLE_STOPPING));
}

}  // namespace
}  // namespace credo::test
