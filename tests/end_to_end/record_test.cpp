// The real program records a virtual sensor; what it recorded is what the sensor played.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "drivers/virtual/plain_dataset.hpp"
#include "end_to_end/program.hpp"
#include "io/dataset.hpp"
#include "openni/oni_source.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Read {
  std::vector<FramePtr> frames;
  std::map<std::string, int> lost;
  std::vector<std::string> warnings;
};

Read read_all(OpenedSource const& opened) {
  Read read;
  read.warnings = opened.warnings;
  while (true) {
    SourceResult result = opened.source->next();
    if (auto* frame = std::get_if<FramePtr>(&result)) {
      read.frames.push_back(std::move(*frame));
    } else if (auto const* failure = std::get_if<FrameFailure>(&result)) {
      ++read.lost[failure->reason];
    } else {
      return read;
    }
  }
}

Read read_folder(fs::path const& folder) {
  return read_all(open_dataset(folder, {}, {}));
}

Read read_oni(fs::path const& file) {
  return read_all(open_oni(file, {}, {}));
}

bool sha256sum_passes(fs::path const& list) {
  std::string const command = "cd '" + list.parent_path().string() +
                              "' && sha256sum --strict --quiet -c '" + list.filename().string() +
                              "'";
  return std::system(command.c_str()) == 0;
}

/// In millimetres, which the dataset of the virtual sensor is in.
Grid<std::uint16_t> counts_of(Frame const& frame, double unit_m = 0.001) {
  Grid<std::uint16_t> counts(frame.cloud_camera.width(), frame.cloud_camera.height());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    float const z_m = frame.cloud_camera.z[i];
    auto const count = std::isnan(z_m) ? 0 : std::lround(static_cast<double>(z_m) / unit_m);
    counts[i] = static_cast<std::uint16_t>(count);
  }
  return counts;
}

/// Every image is known by its first pixel.
std::size_t image_of(Grid<std::uint16_t> const& counts) {
  return (counts[0] - 300U) / 60U;
}

class Record : public ::testing::Test {
protected:
  static constexpr std::size_t kImages = 12;

  void SetUp() override {
    write_dataset(folder_ / "a", kImages);
    play("");
    ::setenv("LD_LIBRARY_PATH", CREDO_OPENNI2_PRIVATE, 1);
  }
  void play(std::string const& faults) {
    write_text(folder_ / "s.json",
               R"({"sensors": [{"name": "a", "dataset": "a", "faults": [)" + faults + "]}]}");
    ::setenv("CREDO_VIRTUAL_SENSOR", (folder_ / "s.json").c_str(), 1);
  }
  [[nodiscard]] std::vector<std::string> arguments(std::string const& out,
                                                   std::vector<std::string> const& more) const {
    std::vector<std::string> all = {"record", "--source", "openni:virtual://a", "--out",
                                    (folder_ / out).string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] Ended record(std::string const& out, std::vector<std::string> const& more) const {
    return credo(arguments(out, more));
  }
  /// Until it holds so many bytes.
  static void wait_for(fs::path const& file, std::uintmax_t bytes) {
    auto const end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    std::error_code error;
    while ((!fs::exists(file) || fs::file_size(file, error) < bytes) &&
           std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  static void expect_as_played(Read const& read) {
    EXPECT_THAT(read.lost, IsEmpty());
    int colored = 0;
    for (FramePtr const& frame : read.frames) {
      Grid<std::uint16_t> const counts = counts_of(*frame);
      std::size_t const image = image_of(counts);
      ASSERT_LT(image, kImages);
      EXPECT_EQ(counts, depth_of(image));
      if (!frame->color.empty()) {
        EXPECT_EQ(frame->color, color_of(image)) << "of its depth's moment";
        ++colored;
      }
      EXPECT_NEAR(frame->intrinsics.fx_px, kFocal_px, 1e-3);
    }
    EXPECT_GT(colored, 0);
  }

  TempFolder folder_;
};

TEST_F(Record, AFolderHoldsWhatTheSensorGave) {
  Ended const ended = record("out", {"--frames", "20"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::string const out = (folder_ / "out").string();
  EXPECT_THAT(ended.out,
              ContainsRegex("^20 frames, [0-9]+ lost.*, [0-9.]+ s, [0-9.]+ MB in " + out +
                            "; play it back: credo run --source dataset:" + out + "\n$"));
  Read const read = read_folder(folder_ / "out");
  EXPECT_THAT(read.warnings, IsEmpty());
  ASSERT_EQ(read.frames.size(), 20U);
  expect_as_played(read);
  for (FramePtr const& frame : read.frames) {
    EXPECT_TRUE(frame->color_registered);
    // The virtual sensor's time: 1 s, and 1/30 s an image.
    double const tick = static_cast<double>(frame->stamp_ns - 1'000'000'000) * 30e-9;
    EXPECT_NEAR(tick, std::round(tick), 1e-3);
    EXPECT_EQ(static_cast<std::size_t>(std::lround(tick)) % kImages, image_of(counts_of(*frame)));
  }
  EXPECT_TRUE(sha256sum_passes(folder_ / "out/SHA256SUMS"));
}

TEST_F(Record, AnOniHoldsWhatTheSensorGave) {
  Ended const ended = record("out/a.oni", {"--frames", "20"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::string const out = (folder_ / "out/a.oni").string();
  EXPECT_THAT(ended.out, HasSubstr("play it back: credo run --source oni:" + out +
                                   " --set capture.color_registered=yes\n"));
  Read const read = read_oni(folder_ / "out/a.oni");
  EXPECT_THAT(read.warnings, IsEmpty());
  EXPECT_GE(read.frames.size(), 19U);
  expect_as_played(read);
  EXPECT_TRUE(sha256sum_passes(folder_ / "out/a.oni.sha256"));
  // The recorder's own file is twice as long.
  EXPECT_LT(fs::file_size(folder_ / "out/a.oni"), read.frames.size() * 20'000 + 100'000);
}

TEST_F(Record, DepthThatIsNotRegisteredIsRecordedAsItIs) {
  play(R"({"fault": "registration_missing"})");
  Ended const ended = record("out", {"--frames", "5"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("does not register its depth to its colour"));
  for (FramePtr const& frame : read_folder(folder_ / "out").frames) {
    EXPECT_FALSE(frame->color_registered);
    Grid<std::uint16_t> const counts = counts_of(*frame);
    bool found = false;
    for (std::size_t image = 0; image < kImages; ++image) {
      found = found || counts == literally_unregistered(depth_of(image));
    }
    EXPECT_TRUE(found);
  }
  Ended const software = record("soft", {"--frames", "5", "--set", "sensor.registration=software"});
  ASSERT_EQ(software.code, 0) << software.err;
  EXPECT_THAT(software.err, Not(HasSubstr("rounded")));
  EXPECT_TRUE(read_folder(folder_ / "soft").frames.at(0)->color_registered);
}

TEST_F(Record, OtherUnitsOfDepthComeBack) {
  Ended const ended = record("out", {"--frames", "3", "--set", "capture.depth_unit_m=0.0001"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, Not(HasSubstr("rounded")));
  for (FramePtr const& frame : read_folder(folder_ / "out").frames) {
    Grid<std::uint16_t> const counts = counts_of(*frame, 0.0001);
    EXPECT_EQ(counts, depth_of(image_of(counts)));
  }
}

TEST_F(Record, AnyOtherSourceGoesIntoAFolder) {
  std::string const source = "dataset:" + (folder_ / "a").string();
  Ended const ended = credo({"record", "--source", source, "--out", (folder_ / "out").string()});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("12 frames, 0 lost, "));
  Read const read = read_folder(folder_ / "out");
  ASSERT_EQ(read.frames.size(), kImages);
  expect_as_played(read);
  EXPECT_FALSE(read.frames[0]->color_registered);
  Ended const oni = credo({"record", "--source", source, "--out", (folder_ / "b.oni").string()});
  EXPECT_EQ(oni.code, 2);
  EXPECT_EQ(oni.err, "credo: --out " + (folder_ / "b.oni").string() +
                         ": only a sensor (--source openni:) is recorded as .oni; name a folder to "
                         "record " +
                         source + "\n");
  Ended const half = credo(
      {"record", "--source", source, "--seconds", "0.2", "--out", (folder_ / "half").string()});
  EXPECT_THAT(half.out, HasSubstr("6 frames, 0 lost, ")) << "by its stamps";
}

TEST_F(Record, WhatIsThereAlreadyStays) {
  write_text(folder_ / "b.oni", "mine");
  fs::create_directories(folder_ / "out");
  for (std::string const name : {"out", "b.oni"}) {
    Ended const ended = record(name, {"--frames", "3"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("credo: " + (folder_ / name).string() +
                                     ": is there already; name a new f"));
  }
  EXPECT_EQ(read_text(folder_ / "b.oni"), "mine");
  EXPECT_TRUE(fs::is_empty(folder_ / "out"));
}

TEST_F(Record, CtrlCEndsItWithAllWritten) {
  for (std::string const name : {"out", "a.oni"}) {
    Program program(credo_command(arguments(name, {})));
    wait_for(name == "out" ? folder_ / "out/depth.txt" : folder_ / name,
             name == "out" ? 10 * 29 : 200'000);
    program.send(SIGINT);
    Ended const ended = program.wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(" in " + (folder_ / name).string() + "; play it back"));
  }
  Read const folder = read_folder(folder_ / "out");
  EXPECT_GE(folder.frames.size(), 10U);
  EXPECT_THAT(folder.warnings, IsEmpty());
  EXPECT_TRUE(sha256sum_passes(folder_ / "out/SHA256SUMS"));
  expect_as_played(read_oni(folder_ / "a.oni"));
  EXPECT_TRUE(sha256sum_passes(folder_ / "a.oni.sha256"));
}

TEST_F(Record, AFolderWhoseRecorderWasKilledReadsUpToThere) {
  Program program(credo_command(arguments("out", {})));
  wait_for(folder_ / "out/depth.txt", 10 * 29);
  program.send(SIGKILL);
  program.wait();
  EXPECT_TRUE(sha256sum_passes(folder_ / "out/SHA256SUMS"));
  Read const read = read_folder(folder_ / "out");
  EXPECT_GE(read.frames.size(), 10U);
  expect_as_played(read);
  EXPECT_THAT(read.warnings, testing::ElementsAre(HasSubstr("was cut short")));
}

TEST_F(Record, SecondsEndIt) {
  EXPECT_THAT(record("out", {"--seconds", "1"}).out,
              ContainsRegex("^[0-9]+ frames, .*, 1\\.[0-9] s"));
  EXPECT_THAT(record("a.oni", {"--seconds", "1"}).out,
              ContainsRegex("^[0-9]+ frames, .*, 1\\.[0-9] s"));
}

TEST_F(Record, LossesAreCounted) {
  play(R"({"fault": "stall", "at_frame": 10, "for_s": 1.5})");
  std::vector<std::string> const more = {"--seconds", "4", "--set", "sensor.stall_s=0.8"};
  Ended const folder = record("out", more);
  EXPECT_EQ(folder.code, 0) << folder.err;
  EXPECT_THAT(folder.out, ContainsRegex("lost \\(.*[0-9]+ missed, 1 stalled\\)"));
  expect_as_played(read_folder(folder_ / "out"));
  Ended const oni = record("a.oni", more);
  EXPECT_EQ(oni.code, 0) << oni.err;
  EXPECT_THAT(oni.out, ContainsRegex("lost \\(.*[0-9]+ missed, 1 stalled\\)"));
  expect_as_played(read_oni(folder_ / "a.oni"));
}

TEST_F(Record, AnUnpluggedSensorComesBackIntoAFolderAndEndsAnOni) {
  play(R"({"fault": "unplug", "at_s": 1, "for_s": 1})");
  Ended const folder = record("out", {"--seconds", "5"});
  EXPECT_EQ(folder.code, 0) << folder.err;
  EXPECT_THAT(folder.out, HasSubstr("1 unplugged"));
  Read const read = read_folder(folder_ / "out");
  expect_as_played(read);
  EXPECT_GT(read.frames.back()->stamp_ns - read.frames.front()->stamp_ns, 2'000'000'000);
  Ended const oni = record("a.oni", {"--seconds", "30"});
  EXPECT_EQ(oni.code, 0) << oni.err;
  EXPECT_THAT(oni.err, HasSubstr("openni:virtual://a was unplugged: the recording ends there"));
  expect_as_played(read_oni(folder_ / "a.oni"));
}

TEST_F(Record, NoFrameLeavesNothing) {
  play(R"({"fault": "stall"})");
  for (std::string const name : {"out", "a.oni"}) {
    Ended const ended = record(name, {"--seconds", "1", "--set", "sensor.first_frame_s=0.5"});
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("credo: openni:virtual://a: not one frame came (1 stalled"));
    EXPECT_FALSE(fs::exists(folder_ / name));
  }
}

// A limit on the size of files stands for a full disk.
TEST_F(Record, AFullDiskIsToldAndWhatWasWrittenStays) {
  auto const limited = [&](std::string const& kilobytes, std::string const& name,
                           std::string const& seconds) {
    std::vector<std::string> command = {
        "bash", "-c", "trap '' XFSZ; ulimit -f " + kilobytes + "; exec \"$@\"", "bash"};
    for (std::string const& word : credo_command(arguments(name, {"--seconds", seconds}))) {
      command.push_back(word);
    }
    return Program(command).wait();
  };
  Ended const folder = limited("16", "out", "60");
  EXPECT_EQ(folder.code, 2) << folder.err;
  EXPECT_THAT(folder.err,
              ContainsRegex("credo: .*: cannot be written: is the disk full.* The [0-9]+ "
                            "frames before are whole, and in "));
  Read const read = read_folder(folder_ / "out");
  EXPECT_THAT(folder.err, HasSubstr("The " + std::to_string(read.frames.size()) + " frames"));
  EXPECT_GT(read.frames.size(), 10U);
  expect_as_played(read);
  EXPECT_TRUE(sha256sum_passes(folder_ / "out/SHA256SUMS"));

  Ended const oni = limited("500", "a.oni", "3");
  EXPECT_EQ(oni.code, 2) << oni.err;
  EXPECT_THAT(oni.err, HasSubstr("is the disk full"));
  EXPECT_FALSE(fs::exists(folder_ / "a.oni.sha256"));
}

TEST_F(Record, ADamagedOniIsNotPlayed) {
  ASSERT_EQ(record("a.oni", {"--frames", "10"}).code, 0);
  damage_file(folder_ / "a.oni", 0.5);
  std::string const file = (folder_ / "a.oni").string();
  Ended const ended = credo({"run", "--no-dds", "--source", "oni:" + file});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "credo: " + file +
                           ": is damaged, or was changed: it does not match its checksum in "
                           "a.oni.sha256; restore it from a copy, or remove its line there to read "
                           "it as it is\n");
  fs::rename(folder_ / "a.oni", folder_ / "b.oni");
  fs::rename(folder_ / "a.oni.sha256", folder_ / "b.oni.sha256");
  EXPECT_THAT(credo({"run", "--no-dds", "--source", "oni:" + (folder_ / "b.oni").string()}).err,
              HasSubstr("b.oni.sha256: has no line for b.oni"));
}

TEST_F(Record, ADamagedImageCostsItsFrameInARun) {
  ASSERT_EQ(record("out", {"--frames", "10"}).code, 0);
  std::vector<std::string> const lines = read_lines(folder_ / "out/depth.txt");
  damage_file(folder_ / "out" / lines[4].substr(lines[4].find("depth/")), 0.5);
  Ended const ended =
      credo({"run", "--no-dds", "--source", "dataset:" + (folder_ / "out").string()});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("10 frames in, 9 out, 1 failed (1 checksum)"));
}

}  // namespace
}  // namespace credo::test
