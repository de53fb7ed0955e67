// What is wrong with a recording: at open it is exit 2, one line and no --out; later it costs its
// frame, counted under its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "end_to_end/contract.hpp"
#include "end_to_end/floor_dataset.hpp"
#include "end_to_end/program.hpp"
#include "io/image.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Ended;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kFrames = 5;

/// One way in which a frame of a recording is spoilt.
struct Spoilt {
  std::string name;
  /// depth.png, color.png or pose.txt; pcd for a recording of clouds.
  std::string kind;
  std::function<void(fs::path const&)> spoil;
  std::string reason;
  /// After the file's name.
  std::string text;
};

void write_words(fs::path const& path) {
  test::write_text(path, "this is no image");
}
void cut(fs::path const& path) {
  test::cut_file(path, 0.5);
}
void drop(fs::path const& path) {
  fs::remove(path);
}

class SpoiltFrames : public ::testing::TestWithParam<Spoilt> {
protected:
  /// Writes a recording whose frame `frame` is spoilt and returns the file that is to blame.
  fs::path write(int frame) {
    fs::path file;
    if (GetParam().kind == "pcd") {
      test::write_floor_clouds(folder_ / "in", kFrames);
      file = folder_ / "in" / ("000" + std::to_string(frame) + ".pcd");
    } else {
      test::write_floor_dataset(folder_ / "in", kFrames);
      file = test::frame_file(folder_ / "in", frame, GetParam().kind);
    }
    GetParam().spoil(file);
    return file;
  }
  Ended run() {
    return test::credo({"run", "--source", "dataset:" + (folder_ / "in").string(), "--out",
                        out().string(), "--dump", "labels"});
  }
  [[nodiscard]] fs::path out() const { return folder_ / "out"; }

  test::TempFolder folder_;
};

TEST_P(SpoiltFrames, AtTheStartAreExit2WithOneLineAndNoOutput) {
  std::string const file = write(0).string();
  Ended const ended = run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "credo: " + file + ": " + GetParam().text + "\n");
  EXPECT_EQ(ended.out, "");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_P(SpoiltFrames, LaterCostThemselvesAndAreCountedUnderTheirReason) {
  std::string const file = write(2).string();
  Ended const ended = run();
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.err, HasSubstr("frame 2 lost: " + GetParam().reason + ": " + file + ": " +
                                   GetParam().text + "\n"));
  json const metrics = json::parse(test::read_text(out() / "metrics.json"));
  EXPECT_EQ(metrics["frames_in"], kFrames);
  EXPECT_EQ(metrics["frames_out"], kFrames - 1);
  EXPECT_EQ(metrics["failures"], (json{{GetParam().reason, 1}}));
  std::vector<int> frames;
  for (std::string const& line : test::read_lines(out() / "belief.jsonl")) {
    frames.push_back(json::parse(line)["frame"]);
  }
  EXPECT_THAT(frames, ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(test::contract_faults(out()), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, SpoiltFrames,
    ::testing::Values(
        Spoilt{"UnreadableDepth", "depth.png", write_words, "unreadable_image", "not a PNG"},
        Spoilt{"UnreadableColour", "color.png", write_words, "unreadable_image",
               "neither PNG nor JPEG"},
        Spoilt{"CutDepth", "depth.png", cut, "truncated_image", "cut short"},
        Spoilt{"CutColour", "color.png", cut, "truncated_image", "cut short"},
        Spoilt{"ColourOfAnotherSize", "color.png",
               [](fs::path const& path) { write_png_rgb(path, Grid<Rgb>(40, 30)); }, "wrong_size",
               "is 40x30, its depth 80x60"},
        Spoilt{
            "FifteenNumbers", "pose.txt",
            [](fs::path const& path) { test::write_text(path, "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0"); },
            "bad_pose", "needs 16 numbers, has 15"},
        Spoilt{"PoseWithNan", "pose.txt",
               [](fs::path const& path) {
                 test::write_text(path, "1 0 0 nan 0 1 0 0 0 0 1 0 0 0 0 1");
               },
               "bad_pose", "pose has a number that is not finite"},
        Spoilt{"CutCloud", "pcd", [](fs::path const& path) { test::cut_file(path, 0.01); },
               "bad_cloud", "cut short, has 43 of 4800 points"},
        Spoilt{"NoCloud", "pcd", write_words, "bad_cloud",
               "not a PCD file: its header needs FIELDS, WIDTH, HEIGHT and DATA"}),
    [](auto const& instance) { return instance.param.name; });

class BadRecordings : public ::testing::Test {
protected:
  /// The one line that the run ends with, the folder left out.
  std::string error(std::vector<std::string> const& more = {}) {
    std::vector<std::string> arguments = {"run", "--source", "dataset:" + (folder_ / "in").string(),
                                          "--out", (folder_ / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Ended const ended = test::credo(arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    std::string text = ended.err;
    std::string const name = folder_.path().string();
    for (std::size_t at = 0; (at = text.find(name)) != std::string::npos;) {
      text.erase(at, name.size());
    }
    return text;
  }

  test::TempFolder folder_;
};

TEST_F(BadRecordings, AnEmptyFolder) {
  fs::create_directories(folder_ / "in");
  EXPECT_EQ(error(),
            "credo: dataset /in: no frames found; known are frame-NNNNNN.depth.png with "
            ".color.jpg|png, NNNN.depth.png with .color.png, TUM depth.txt with rgb.txt, and "
            "*.pcd\n");
}

TEST_F(BadRecordings, AFileInPlaceOfTheFolder) {
  test::write_text(folder_ / "in", "");
  EXPECT_EQ(error(), "credo: dataset /in: not a folder\n");
}

TEST_F(BadRecordings, DepthWithoutColour) {
  test::write_floor_dataset(folder_ / "in", kFrames);
  for (int i = 0; i < kFrames; ++i) {
    drop(test::frame_file(folder_ / "in", i, "color.png"));
  }
  EXPECT_EQ(error(), "credo: /in/frame-000000.depth.png: depth without colour\n");
}

TEST_F(BadRecordings, IntrinsicsOfAnotherResolution) {
  test::write_floor_dataset(folder_ / "in", kFrames);
  test::write_text(folder_ / "in/camera-intrinsics.txt", "525 0 320 0 525 240 0 0 1");
  EXPECT_EQ(error(),
            "credo: /in/camera-intrinsics.txt: principal point (320, 240) is not in the 80x60 "
            "image: intrinsics of another resolution?\n");
}

TEST_F(BadRecordings, ATrajectoryThatIsNotThere) {
  test::write_floor_dataset(folder_ / "in", kFrames);
  EXPECT_EQ(
      error({"--set", "pose.source=file", "--set", "pose.file=" + (folder_ / "none.txt").string()}),
      "credo: /none.txt: trajectory cannot be read\n");
}

TEST_F(BadRecordings, AConfigWithEveryKindOfFault) {
  test::write_floor_dataset(folder_ / "in", kFrames);
  test::write_text(folder_ / "a.yaml",
                   "normals:\n  radius: 0.03\n  max_depth_jump_m: 2.0\nplanes:\n  max_planes: "
                   "many\n  max_planes: 3\npose: {level: maybe}\n");
  EXPECT_EQ(error({"--config", (folder_ / "a.yaml").string()}),
            "credo: /a.yaml:2:3: unknown key normals.radius (did you mean radius_m?)\n"
            "credo: /a.yaml:3:3: normals.max_depth_jump_m = 2.0: must be in [0, 1] m\n"
            "credo: /a.yaml:5:3: planes.max_planes = many: must be a whole number\n"
            "credo: /a.yaml:6:3: duplicate key planes.max_planes\n"
            "credo: /a.yaml:7:8: pose.level = maybe: must be one of off, auto, given, floor\n");
}

TEST_F(BadRecordings, AConfigThatIsNotThere) {
  EXPECT_EQ(error({"--config", (folder_ / "none.yaml").string()}),
            "credo: /none.yaml: cannot be read\n");
}

}  // namespace
}  // namespace credo
