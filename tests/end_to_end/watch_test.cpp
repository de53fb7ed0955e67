// The belief in another process: `credo run` publishes, `credo watch` listens, on the loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "end_to_end/program.hpp"
#include "support/paths.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Watch : public ::testing::Test {
protected:
  /// Topics that nobody else on this machine uses.
  [[nodiscard]] std::vector<std::string> own_topics() const {
    return {"--set", "dds.topic_prefix=test_" + std::to_string(getpid())};
  }
  std::vector<std::string> run_and_linger(std::string const& name, std::string const& frames) {
    return with_topics({"run", "--source", "sim:first-light", "--frames", frames, "--out",
                        (folder_ / name).string(), "--linger", "60", "--set",
                        "dds.source=" + name});
  }
  std::vector<std::string> with_topics(std::vector<std::string> arguments) const {
    for (std::string const& argument : own_topics()) {
      arguments.push_back(argument);
    }
    return arguments;
  }
  /// Until it lingers: metrics are written after the last frame.
  void wait_for_end_of_frames(std::string const& name) {
    for (int i = 0; i < 1200 && read_text(folder_ / name / "metrics.json").empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  TempFolder folder_;
};

TEST_F(Watch, WhoComesAfterTheLastFrameHasTheLastLine) {
  Program run(credo_command(run_and_linger("robot", "4")));
  wait_for_end_of_frames("robot");
  for (int i = 0; i < 2; ++i) {
    Ended const ended = credo(with_topics({"watch", "--json", "--once", "--timeout", "20"}));
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, read_lines(folder_ / "robot/belief.jsonl").back() + "\n");
  }
  Ended const table = credo(with_topics({"watch", "--once", "--timeout", "20"}));
  EXPECT_THAT(table.out, StartsWith("robot  frame 3  "));
  EXPECT_THAT(table.out, HasSubstr("wall"));
  run.send(SIGINT);
  Ended const ended = run.wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
}

TEST_F(Watch, TwoAreToldApart) {
  Program one(credo_command(run_and_linger("one", "2")));
  Program two(credo_command(run_and_linger("two", "3")));
  wait_for_end_of_frames("one");
  wait_for_end_of_frames("two");
  for (std::string const name : {"one", "two"}) {
    Ended const ended = credo(with_topics(
        {"watch", "--json", "--once", "--timeout", "20", "--set", "dds.source=" + name}));
    EXPECT_EQ(ended.out, read_lines(folder_ / name / "belief.jsonl").back() + "\n");
  }
  one.send(SIGTERM);
  two.send(SIGTERM);
  EXPECT_EQ(one.wait().code, 0);
  EXPECT_EQ(two.wait().code, 0);
}

// A watcher from before the run sees beliefs come, in order, and that their source leaves.
TEST_F(Watch, FollowsARunToItsEnd) {
  Program watcher(credo_command(with_topics({"watch", "--json", "--timeout", "8"})));
  Ended const run = credo(
      with_topics({"run", "--source", "sim:first-light", "--frames", "8", "--out",
                   (folder_ / "run").string(), "--set", "dds.source=robot", "--linger", "1"}));
  EXPECT_EQ(run.code, 0) << run.err;
  Ended const watched = watcher.wait();
  EXPECT_EQ(watched.code, 1) << "nothing comes any more";
  EXPECT_THAT(watched.err, HasSubstr("credo: robot has left\n"));
  std::istringstream lines(watched.out);
  std::vector<std::string> const expected = read_lines(folder_ / "run/belief.jsonl");
  std::string last;
  int frame = -1;
  for (std::string line; std::getline(lines, line); last = line) {
    int const now = json::parse(line)["frame"];
    EXPECT_GT(now, frame);
    frame = now;
    EXPECT_EQ(line, expected.at(static_cast<std::size_t>(now)));
  }
  EXPECT_EQ(last, expected.back());
}

// One that is stopped in the middle neither stalls the run nor loses it a frame.
TEST_F(Watch, AStoppedWatcherStallsNothing) {
  Program watcher(credo_command(with_topics({"watch", "--json"})));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  watcher.send(SIGSTOP);
  Ended const run = credo(with_topics({"run", "--source", "sim:first-light", "--frames", "60",
                                       "--out", (folder_ / "run").string()}));
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("60 frames in, 60 out, 0 failed, 0 dropped"));
  watcher.send(SIGCONT);
  watcher.send(SIGINT);
  EXPECT_EQ(watcher.wait().code, 0);
}

TEST_F(Watch, WithoutABeliefItSaysWhereItListened) {
  Ended const ended = credo(with_topics({"watch", "--once", "--timeout", "0.5"}));
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.err, "credo: no belief on DDS topic test_" + std::to_string(getpid()) +
                           "/belief, domain 0, interface lo, for 0.5 s\n");
}

TEST_F(Watch, TheProjectsDdsFileIsOneThatDdsTakes) {
  std::string const uri = "file://" + (source_folder() / "config/cyclonedds.xml").string();
  setenv("CYCLONEDDS_URI", uri.c_str(), 1);
  Ended const good = credo(with_topics({"watch", "--once", "--timeout", "0.3"}));
  setenv("CYCLONEDDS_URI", "<nonsense", 1);
  Ended const bad = credo(with_topics({"watch", "--once", "--timeout", "0.3"}));
  unsetenv("CYCLONEDDS_URI");
  EXPECT_EQ(good.code, 1);
  EXPECT_THAT(good.err, StartsWith("credo: no belief on DDS topic "));
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.err, StartsWith("credo: CYCLONEDDS_URI: DDS does not start: "));
}

TEST_F(Watch, ABadInterfaceOrDomainIsOneLine) {
  Ended const interface = credo({"watch", "--once", "--set", "dds.interface=nope0"});
  EXPECT_EQ(interface.code, 2);
  EXPECT_EQ(
      interface.err,
      "credo: dds.interface nope0, dds.domain 0: DDS does not start: nope0: does not match an "
      "available interface.\n");
  Ended const run = credo({"run", "--source", "sim:first-light", "--out",
                           (folder_ / "out").string(), "--set", "dds.interface=nope0"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err,
              HasSubstr("does not match an available interface.; --no-dds runs without\n"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(credo({"watch", "--once", "--set", "dds.domain=500"}).err,
            "credo: --set dds.domain=500: dds.domain = 500: must be in [0, 230]\n");
}

}  // namespace
}  // namespace credo::test
