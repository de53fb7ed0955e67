// A detector in another process, through the real program and the real example.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "dds/remote_detector.hpp"
#include "end_to_end/detection_recording.hpp"
#include "end_to_end/program.hpp"
#include "support/paths.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class RemoteDetection : public testing::Test {
protected:
  RemoteDetection() { dds_.topic_prefix = "detector_" + std::to_string(getpid()); }

  /// The example, which answers with what the file says.
  [[nodiscard]] std::unique_ptr<Program> example(fs::path const& file) const {
    std::string const uri = "file://" + (source_folder() / "config/cyclonedds.xml").string();
    setenv("CYCLONEDDS_URI", uri.c_str(), 1);
    auto program = std::make_unique<Program>(
        std::vector<std::string>{CREDO_EXAMPLE_DETECTOR, file.string(), dds_.topic_prefix});
    unsetenv("CYCLONEDDS_URI");
    return program;
  }

  [[nodiscard]] Ended run(std::string const& out, std::vector<std::string> const& more) const {
    std::vector<std::string> arguments = {
        "run",
        "--source",
        "sim:box-on-table",
        "--prior",
        (source_folder() / "scenes/priors/box-on-table.yaml").string(),
        "--out",
        (folder_ / out).string(),
        "--set",
        "dds.topic_prefix=" + dds_.topic_prefix};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return credo(std::move(arguments));
  }
  [[nodiscard]] std::string beliefs(std::string const& out) const {
    return read_text(folder_ / out / "belief.jsonl");
  }

  /// Off the truth, with a frame in which the box is missed, one in which nothing is found, and a
  /// type that nobody knows.
  [[nodiscard]] fs::path recording() const {
    fs::path const path = folder_ / "detections.jsonl";
    Scene const scene = project_scene("box-on-table");
    DetectionRecording recording(path, scene);
    for (std::int64_t frame : {0, 1, 3, 4, 5, 7, 8}) {
      recording.frame(frame).sees("table", {0.001 * static_cast<double>(frame), 0, 0});
      if (frame != 4) {
        recording.sees("box", {0, 0.002, 0.001});
      }
    }
    recording.finish();
    return path;
  }

  DdsConfig dds_;
  TempFolder folder_;
};

TEST_F(RemoteDetection, GivesTheBeliefThatTheSameDetectionsGiveInAFile) {
  fs::path const file = recording();
  Ended const recorded = run("recorded", {"--set", "detector.kind=recorded", "--set",
                                          "detector.file=" + file.string(), "--no-dds"});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  auto const detector = example(file);
  for (bool const published : {true, false}) {
    std::vector<std::string> arguments = {"--set", "detector.kind=remote", "--set",
                                          "detector.remote.timeout_s=60"};
    if (!published) {
      arguments.emplace_back("--no-dds");
    }
    Ended const remote = run("remote", arguments);
    ASSERT_EQ(remote.code, 0) << remote.err;
    EXPECT_EQ(beliefs("remote"), beliefs("recorded"));
    EXPECT_THAT(remote.err, Not(HasSubstr("nobody looks")));
    EXPECT_THAT(remote.out, HasSubstr("objects: 13 detections taken, 0 refused\n"));
  }
  EXPECT_THAT(read_lines(folder_ / "recorded/belief.jsonl"), SizeIs(9U));
  detector->send(SIGTERM);
  EXPECT_EQ(detector->wait().code, 0);
}

std::size_t count(std::string const& text, std::string const& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST_F(RemoteDetection, WithoutADetectorTheBeliefIsThatOfNoneAndItIsToldOnce) {
  Ended const none = run("none", {"--no-dds"});
  ASSERT_EQ(none.code, 0) << none.err;
  Ended const silent = run("silent", {"--no-dds", "--set", "detector.kind=remote", "--set",
                                      "detector.remote.timeout_s=0.1"});
  ASSERT_EQ(silent.code, 0) << silent.err;
  EXPECT_EQ(beliefs("silent"), beliefs("none"));
  EXPECT_EQ(count(silent.err, "nobody looks for known objects: nobody answers on " +
                                  dds_.topic_prefix + "/detection_request"),
            1U);
  EXPECT_EQ(count(silent.err, "nobody"), 2U) << silent.err;
}

// The example passes on what the file says; nobody else has looked at it.
TEST_F(RemoteDetection, AReplyThatCannotBeCostsItsFrameAlone) {
  std::string covariance = "0";
  for (int i = 1; i < 36; ++i) {
    covariance += ",0";
  }
  fs::path const file = folder_ / "flat.jsonl";
  write_text(file, R"({"frame":3,"detections":[{"type":"table","position":[0,0,1],)"
                   R"("orientation_xyzw":[0,0,0,1],"score":1,"covariance":[)" +
                       covariance + "]}]}\n");
  auto const detector = example(file);
  Ended const ended =
      run("out", {"--set", "detector.kind=remote", "--set", "detector.remote.timeout_s=60"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(read_lines(folder_ / "out/belief.jsonl"), SizeIs(8U));
  EXPECT_THAT(ended.err, HasSubstr("the detector's reply to frame 3: detections[0] (table): "
                                   "covariance must be symmetric and positive definite"));
}

// Killed, it does not say goodbye: until DDS notices, frames wait for it in vain.
TEST_F(RemoteDetection, ADetectorThatIsKilledAndStartedAgainIsAskedAgain) {
  fs::path const file = folder_ / "detections.jsonl";
  std::string lines;
  for (int frame = 0; frame < 300; ++frame) {
    lines += "{\"frame\":" + std::to_string(frame) + ",\"detections\":[]}\n";
  }
  write_text(file, lines);
  std::vector<std::string> told;
  RemoteDetectorConfig config;
  config.timeout_s = 0.5;
  RemoteDetector remote(dds_, config, [&](std::string const& line) { told.push_back(line); });
  std::int64_t asked = 0;
  auto const is_answered = [&] {
    Frame frame;
    frame.index = FrameIndex{asked++};
    try {
      (void)remote.detect(frame, {});
      return true;
    } catch (NobodyLooked const&) {
      return false;
    }
  };
  auto const ask_until = [&](bool answered) {
    while (is_answered() != answered) {
      std::this_thread::sleep_for(20ms);
    }
  };
  for (int life = 0; life < 3; ++life) {
    auto const detector = example(file);
    ask_until(true);
    EXPECT_TRUE(is_answered());
    detector->send(SIGKILL);
    detector->wait();
    ask_until(false);
  }
  EXPECT_GE(told.size(), 5U);
}

TEST_F(RemoteDetection, ADdsThatDoesNotStartIsToldInOneLine) {
  Ended const ended =
      run("out", {"--no-dds", "--set", "detector.kind=remote", "--set", "dds.interface=nowhere0"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("dds.interface nowhere0, dds.domain 0: DDS does not start"));
  EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace credo::test
