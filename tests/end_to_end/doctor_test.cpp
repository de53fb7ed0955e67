// `credo doctor` on virtual sensors with and without faults. How fast images come is this
// machine's matter, and not held.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "io/image.hpp"
#include "support/sensor_views.hpp"
#include "tools/scene_file.hpp"

namespace credo::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class Doctor : public ::testing::Test {
protected:
  /// A Kinect's views of a table in a room: `room` registered, `raw` as its depth camera sees it.
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    Scene const scene = load_scene("cluttered-table");
    for (int i = 0; i < 6; ++i) {
      auto const views = sensor_views(scene, SensorModel::kGaussian, i / 6.0);
      write_images("room", i, views.registered_m, views.color);
      write_images("raw", i, views.depth_m, views.color);
    }
    ::setenv("LD_LIBRARY_PATH", CREDO_OPENNI2_FOLDER, 1);
  }
  static void write_images(std::string const& dataset, int image, Grid<float> const& depth_m,
                           Grid<Rgb> const& color) {
    auto const folder = *folder_ / dataset;
    std::filesystem::create_directories(folder);
    Grid<std::uint16_t> depth_mm(depth_m.width(), depth_m.height());
    for (std::size_t p = 0; p < depth_mm.size(); ++p) {
      depth_mm[p] = depth_m[p] > 0.0F ? static_cast<std::uint16_t>(1000.0F * depth_m[p] + 0.5F) : 0;
    }
    std::string const name = "000" + std::to_string(image);
    write_png16(folder / (name + ".depth.png"), depth_mm);
    write_png_rgb(folder / (name + ".color.png"), color);
    write_text(folder / "camera-intrinsics.txt", "525 0 319.5 0 525 239.5 0 0 1");
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  /// What doctor says of a sensor with that fault, where one is given; or of another, where the
  /// arguments name it.
  void examine(std::string const& fault,
               std::vector<std::string> arguments = {"--source", "openni:virtual://room"}) {
    write_text(*folder_ / "s.json",
               R"({"sensors": [{"name": "room", "dataset": "room", "rate_hz": 10, "faults": [)" +
                   fault + R"(]}, {"name": "raw", "dataset": "raw", "rate_hz": 10}]})");
    ::setenv("CREDO_VIRTUAL_SENSOR", (*folder_ / "s.json").c_str(), 1);
    arguments.insert(arguments.begin(), {"doctor", "--json", "--seconds", "2"});
    ended_ = credo(arguments);
    said_ = json::parse(ended_.out, nullptr, false);
  }

  /// Of a finding; null where there is none of that name.
  [[nodiscard]] json said(std::string const& name, char const* key) const {
    for (json const& one : said_["findings"]) {
      if (one["name"] == name) {
        return one[key];
      }
    }
    return nullptr;
  }
  [[nodiscard]] json level(std::string const& name) const { return said(name, "level"); }

  static TempFolder* folder_;
  Ended ended_;
  json said_;
};

TempFolder* Doctor::folder_ = nullptr;

TEST_F(Doctor, FindsAHealthySensorHealthy) {
  examine("");
  EXPECT_EQ(ended_.code, 0) << ended_.out << ended_.err;
  EXPECT_EQ(ended_.err, "");
  EXPECT_EQ(said_["ok"], true);
  for (char const* name :
       {"library", "drivers", "Kinect driver", "virtual://room", "first depth image", "sync",
        "depth", "colour image", "registration", "focal length", "floor", "interface lo", "DDS"}) {
    EXPECT_EQ(level(name), "ok") << name << ended_.out;
  }
  for (char const* name : {"depth rate", "depth lost", "colour rate", "colour lost", "clock"}) {
    EXPECT_NE(level(name), nullptr) << name;
  }
  EXPECT_THAT(said("virtual://room", "found"), HasSubstr("640x480 at 10 Hz"));
  EXPECT_THAT(said("registration", "found"), HasSubstr("its images show it"));
  EXPECT_THAT(said("focal length", "found"), HasSubstr("525.0 px"));
  EXPECT_THAT(said("floor", "found"), HasSubstr("m below the sensor"));
}

TEST_F(Doctor, TellsItToPeople) {
  examine("");
  Ended const ended = credo({"doctor", "--seconds", "1"});
  EXPECT_EQ(ended.code, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("OpenNI2\n  ok       library: "));
  EXPECT_THAT(ended.out, HasSubstr("\nimages\n  ok       depth: "));
  EXPECT_THAT(ended.out, testing::Not(HasSubstr("\033[")));  // no terminal
}

TEST_F(Doctor, HalfTheRate) {
  examine(R"({"fault": "rate", "every": 2})");
  EXPECT_NE(level("depth rate"), "ok");
  EXPECT_EQ(level("depth lost"), "warning");
}

// It says that it registers, as every virtual sensor does, and its images are a depth camera's.
TEST_F(Doctor, RegistrationThatIsNoneAsItsImagesShow) {
  examine("", {"--source", "openni:virtual://raw"});
  EXPECT_EQ(level("registration"), "warning");
  EXPECT_THAT(said("registration", "found"), HasSubstr("its images show that it is not"));
}

// A virtual sensor's unregistered depth has its colour's focal length, as no Kinect's has: images
// then do not tell.
TEST_F(Doctor, RegistrationThatIsIgnored) {
  examine(R"({"fault": "registration_ignored"})");
  EXPECT_THAT(said("registration", "found"),
              testing::Not(testing::EndsWith("and its images show it")));
}

TEST_F(Doctor, RegistrationThatIsMissing) {
  examine(R"({"fault": "registration_missing"})");
  EXPECT_EQ(level("registration"), "warning");
  EXPECT_THAT(said("registration", "found"), HasSubstr("cannot register"));
  EXPECT_EQ(ended_.code, 0);
}

TEST_F(Doctor, ColourOfAnotherMoment) {
  examine(R"({"fault": "color_shift", "by_ms": 12})");
  EXPECT_EQ(level("sync"), "warning");
  EXPECT_THAT(said("sync", "found"), HasSubstr("colour is 12.0 ms after depth (median)"));
}

TEST_F(Doctor, NoColour) {
  examine(R"({"fault": "stall", "stream": "color"})");
  EXPECT_EQ(level("colour"), "warning");
  EXPECT_EQ(level("depth"), "ok");
  EXPECT_EQ(ended_.code, 0);
}

TEST_F(Doctor, ASlowStart) {
  examine(R"({"fault": "slow_start", "delay_s": 6})");
  EXPECT_EQ(level("first depth image"), "warning");
  EXPECT_EQ(level("depth"), "ok");
}

TEST_F(Doctor, NothingAtAll) {
  examine(R"({"fault": "stall"})",
          {"--source", "openni:virtual://room", "--set", "sensor.first_frame_s=0.5"});
  EXPECT_EQ(ended_.code, 1);
  EXPECT_EQ(said_["ok"], false);
  EXPECT_EQ(level("first depth image"), "error");
  EXPECT_EQ(level("DDS"), "ok");
}

TEST_F(Doctor, ImagesThatAreNotWhole) {
  examine(R"({"fault": "corrupt", "how": "size", "stream": "depth", "at_frame": 3})");
  EXPECT_EQ(level("depth images"), "error");
  EXPECT_EQ(ended_.code, 1);
}

TEST_F(Doctor, ASensorThatIsNotThere) {
  examine("", {"--source", "openni:virtual://kitchen"});
  ASSERT_EQ(ended_.code, 1) << ended_.err;
  EXPECT_THAT(said("opening", "found"), HasSubstr("openni:virtual://kitchen: no such sensor"));
}

// What is left to look at is looked at all the same.
TEST_F(Doctor, NoSensor) {
  ::setenv("CREDO_VIRTUAL_SENSOR", "", 1);
  Ended const ended = credo({"doctor", "--json"});
  json const all = json::parse(ended.out);
  if (all["findings"].dump().find("freenect://") != std::string::npos) {
    GTEST_SKIP() << "a Kinect is plugged in here";
  }
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("OpenNI2 lists no sensor"));
  EXPECT_THAT(ended.out, HasSubstr("\"name\": \"DDS\""));
}

TEST_F(Doctor, BadUsageAndConfig) {
  struct Case {
    std::vector<std::string> arguments;
    std::string err;
  };
  for (Case const& c : {Case{{"--source", "dataset:a"}, "is no live sensor; write openni:"},
                        Case{{"--seconds", "0"}, "--seconds"},
                        Case{{"--set", "dds.interfaces=lo"}, "unknown key dds.interfaces"}}) {
    std::vector<std::string> arguments = {"doctor"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    Ended const ended = credo(arguments);
    EXPECT_EQ(ended.code, 2) << c.err;
    EXPECT_THAT(ended.err, HasSubstr(c.err));
    EXPECT_EQ(ended.out, "");
  }
}

}  // namespace
}  // namespace credo::test
