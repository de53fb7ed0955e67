// Subscribers that come, go, die and stop, and publishers that do: nobody else loses a belief by
// it, and the publisher never waits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "dds/belief_publisher.hpp"
#include "end_to_end/program.hpp"
#include "io/belief_json.hpp"
#include "support/paths.hpp"
#include "support/room_belief.hpp"

namespace credo::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Publishes a room with its points at 30 Hz until it is told to stop.
class RoomPublisher {
public:
  explicit RoomPublisher(DdsConfig const& config) : publisher_(config) {
    thread_ = std::jthread([this](std::stop_token const& stop) { publish(stop); });
  }

  /// What was written last.
  std::string stop() {
    thread_.request_stop();
    thread_.join();
    return belief_json(summary_of(room_belief(frames_ - 1)));
  }
  [[nodiscard]] std::int64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t dropped() const { return publisher_.dropped(); }
  [[nodiscard]] Clock::duration longest() const { return longest_; }

private:
  void publish(std::stop_token const& stop) {
    auto next = Clock::now();
    while (!stop.stop_requested()) {
      BeliefState const belief = room_belief(frames_);
      BeliefSummary const summary = summary_of(belief);
      auto const start = Clock::now();
      publisher_.publish(belief, summary);
      longest_ = std::max(longest_, Clock::now() - start);
      ++frames_;
      next += 33ms;
      std::this_thread::sleep_until(next);
    }
  }

  BeliefPublisher publisher_;
  std::atomic<std::int64_t> frames_ = 0;
  Clock::duration longest_{};
  std::jthread thread_;
};

class Subscribers : public ::testing::Test {
protected:
  Subscribers() {
    config_.topic_prefix = "subscribers_" + std::to_string(getpid());
    config_.source = "robot";
  }

  [[nodiscard]] std::vector<std::string> with_topics(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--set", "dds.topic_prefix=" + config_.topic_prefix});
    return arguments;
  }
  [[nodiscard]] std::vector<std::string> watch() const {
    return credo_command(with_topics({"watch", "--json"}));
  }
  /// Of a watcher that is still there: ends it and gives its lines.
  static std::vector<std::string> lines_of(Program& watcher) {
    watcher.send(SIGINT);
    Ended const ended = watcher.wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    std::vector<std::string> lines;
    std::istringstream text(ended.out);
    for (std::string line; std::getline(text, line);) {
      lines.push_back(line);
    }
    return lines;
  }
  void expect_never_waited(RoomPublisher const& publisher) const {
    EXPECT_EQ(publisher.dropped(), 0U);
    // A write that waited for a reader would wait for as long as that is gone.
    EXPECT_LT(publisher.longest(), 1s);
  }

  DdsConfig config_;
};

TEST_F(Subscribers, AHundredThatComeAndAreKilledHarmNobody) {
  Program steady(watch());
  RoomPublisher publisher(config_);
  for (int i = 0; i < 100; ++i) {
    Program passing(watch());
    // From before it has joined to after its first beliefs.
    std::this_thread::sleep_for(std::chrono::milliseconds(2 * i));
    passing.send(i % 3 == 0 ? SIGINT : SIGKILL);
    passing.wait();
  }
  std::this_thread::sleep_for(300ms);
  std::string const last = publisher.stop();
  std::this_thread::sleep_for(500ms);
  std::vector<std::string> const lines = lines_of(steady);
  expect_never_waited(publisher);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.back(), last);
  // All come, but for those written before it had joined; on an overloaded machine some are passed
  // over by newer ones.
  EXPECT_GT(lines.size(), static_cast<std::size_t>(publisher.frames()) / 2);
  Ended const late = credo(with_topics({"watch", "--json", "--once", "--timeout", "20"}));
  EXPECT_EQ(late.out, last + "\n");
}

/// CREDO_STOPPED_S=60 for the whole minute.
std::chrono::seconds stopped_for() {
  char const* given = std::getenv("CREDO_STOPPED_S");  // NOLINT(concurrency-mt-unsafe)
  return std::chrono::seconds(given != nullptr ? std::atoi(given) : 4);
}

// One of the belief and one of things with their points.
TEST_F(Subscribers, OnesThatAreStoppedForAWhileHarmNobodyAndCatchUp) {
  Program steady(watch());
  Program stopped(watch());
  std::string const uri = "file://" + (source_folder() / "config/cyclonedds.xml").string();
  setenv("CYCLONEDDS_URI", uri.c_str(), 1);
  Program with_points({CREDO_EXAMPLE_SUBSCRIBER, config_.topic_prefix + "/stuff"});
  unsetenv("CYCLONEDDS_URI");
  RoomPublisher publisher(config_);
  std::this_thread::sleep_for(1s);
  stopped.send(SIGSTOP);
  with_points.send(SIGSTOP);
  std::int64_t const before = publisher.frames();
  std::this_thread::sleep_for(stopped_for());
  std::int64_t const during = publisher.frames() - before;
  stopped.send(SIGCONT);
  with_points.send(SIGCONT);
  std::this_thread::sleep_for(1s);
  std::string const last = publisher.stop();
  std::this_thread::sleep_for(1s);

  expect_never_waited(publisher);
  std::vector<std::string> const steady_lines = lines_of(steady);
  std::vector<std::string> const stopped_lines = lines_of(stopped);
  ASSERT_FALSE(steady_lines.empty());
  ASSERT_FALSE(stopped_lines.empty());
  EXPECT_EQ(steady_lines.back(), last);
  EXPECT_EQ(stopped_lines.back(), last);
  EXPECT_GT(steady_lines.size(), static_cast<std::size_t>(during) / 2) << "of " << during;
  EXPECT_LT(stopped_lines.size(), steady_lines.size());
  with_points.send(SIGKILL);
  with_points.wait();
}

// One that is killed in the middle, and started again: who listened goes on.
TEST_F(Subscribers, APublisherThatIsRestartedIsFollowed) {
  TempFolder const folder;
  Program steady(watch());
  for (std::string const name : {"first", "second", "third"}) {
    Program run(credo_command(
        with_topics({"run", "--source", "sim:first-light", "--frames", "5", "--set",
                     "dds.source=robot", "--out", (folder / name).string(), "--linger", "60"})));
    for (int i = 0; i < 400 && read_text(folder / name / "metrics.json").empty(); ++i) {
      std::this_thread::sleep_for(50ms);
    }
    std::this_thread::sleep_for(300ms);
    run.send(name == "second" ? SIGTERM : SIGKILL);
    run.wait();
  }
  std::vector<std::string> const lines = lines_of(steady);
  std::vector<std::string> const expected = read_lines(folder / "third/belief.jsonl");
  ASSERT_GE(lines.size(), 3U);
  EXPECT_EQ(lines.back(), expected.back());
  // Each run ends with the same belief, so it came three times.
  EXPECT_EQ(std::ranges::count(lines, expected.back()), 3);
}

}  // namespace
}  // namespace credo::test
