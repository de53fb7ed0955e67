// Whole runs of the real executable.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "end_to_end/contract.hpp"
#include "end_to_end/floor_dataset.hpp"
#include "end_to_end/program.hpp"
#include "support/recordings.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Ended;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

json read_metrics(fs::path const& out) {
  return json::parse(test::read_text(out / "metrics.json"));
}

TEST(Run, LeavesTheFilesItPromises) {
  test::TempFolder const folder;
  fs::path const out = folder / "out";
  Ended const ended = test::credo({"run", "--source", "sim:first-light", "--frames", "4", "--out",
                                   out.string(), "--dump", "labels,pictures", "--no-dds",
                                   "--linger", "0", "--set", "graph.threads=2"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("4 frames in, 4 out, 0 failed, 0 dropped"));
  EXPECT_EQ(test::read_lines(out / "belief.jsonl").size(), 4U);
  EXPECT_TRUE(fs::exists(out / "labels" / "000003.png"));
  EXPECT_TRUE(fs::exists(out / "pictures" / "000003.png"));
  EXPECT_THAT(test::read_text(out / "config.yaml"), HasSubstr("threads: 2"));
  EXPECT_THAT(test::contract_faults(out), IsEmpty());
}

TEST(Run, TenBadFramesInARowAreExit2AndWhatWasDoneStays) {
  test::TempFolder const folder;
  test::write_floor_dataset(folder / "in", 20);
  for (int i = 3; i <= 13; ++i) {
    test::cut_file(test::frame_file(folder / "in", i, "depth.png"), 0.5);
  }
  fs::path const out = folder / "out";
  Ended const ended = test::credo({"run", "--source", "dataset:" + (folder / "in").string(),
                                   "--out", out.string(), "--dump", "labels"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("credo: 10 frames failed in a row, the last frame 12 "
                                   "(truncated_image): "));
  EXPECT_EQ(read_metrics(out)["frames_out"], 3);
  EXPECT_THAT(test::contract_faults(out), IsEmpty());
}

TEST(Run, IndependentFramesEachBeginWithThePrior) {
  test::TempFolder const folder;
  test::write_floor_dataset(folder / "in", 3);
  fs::path const out = folder / "out";
  Ended const ended =
      test::credo({"run", "--source", "dataset:" + (folder / "in").string(), "--out", out.string(),
                   "--set", "capture.independent_frames=true"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (std::string const& line : test::read_lines(out / "belief.jsonl")) {
    EXPECT_EQ(json::parse(line)["segmented_with"], -1);
  }
  EXPECT_THAT(test::contract_faults(out), IsEmpty());
}

TEST(Run, AnInterruptFinishesWhatIsUnderWayAndExitsWith0) {
  for (int const signal : {SIGINT, SIGTERM}) {
    test::TempFolder const folder;
    fs::path const out = folder / "out";
    test::Program program(
        test::credo_command({"run", "--source", "sim:first-light", "--out", out.string()}));
    for (int i = 0; i < 600 && test::read_text(out / "belief.jsonl").empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    program.send(signal);
    Ended const ended = program.wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    json const metrics = read_metrics(out);
    EXPECT_GE(metrics["frames_out"], 1);
    EXPECT_EQ(metrics["frames_out"], metrics["frames_in"]);
    EXPECT_LT(metrics["frames_in"], 100);
    EXPECT_THAT(test::contract_faults(out), IsEmpty());
  }
}

/// Memory in use once the run is warm, and at its end.
void expect_flat_memory(std::string const& source, int frames, double slack_mb) {
  test::TempFolder const folder;
  Ended const ended = test::credo({"run", "--source", source, "--frames", std::to_string(frames),
                                   "--out", (folder / "out").string(), "--set", "graph.threads=2"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  json const metrics = read_metrics(folder / "out");
  EXPECT_EQ(metrics["frames_out"], frames);
  EXPECT_LT(metrics["rss_mb_end"], metrics["rss_mb_at_100"].get<double>() + slack_mb);
}

TEST(Run, MemoryIsFlat) {
  test::TempFolder const folder;
  test::write_floor_dataset(folder / "in", 800);
  // A frame that is kept would cost 0.1 MB, 70 in all.
  expect_flat_memory("dataset:" + (folder / "in").string(), 800, 10.0);
}

TEST(Run, MemoryIsFlatInTheKitchen) {
  CREDO_REQUIRE_RECORDING("kitchen");
  // A frame that is kept would cost 8 MB, 400 in all.
  expect_flat_memory("dataset:" + (test::recordings() / "kitchen").string(), 150, 40.0);
}

TEST(Run, AFullDiskIsToldAndExitsWith2) {
  if (!fs::exists("/dev/full")) {
    GTEST_SKIP() << "no /dev/full on this machine";
  }
  test::TempFolder const folder;
  fs::path const out = folder / "out";
  fs::create_directories(out);
  fs::create_symlink("/dev/full", out / "belief.jsonl");
  Ended const ended =
      test::credo({"run", "--source", "sim:first-light", "--frames", "3", "--out", out.string()});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("belief.jsonl: cannot be written"));
}

}  // namespace
}  // namespace credo
