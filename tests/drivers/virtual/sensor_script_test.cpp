#include "drivers/virtual/sensor_script.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class Script : public ::testing::Test {
protected:
  std::vector<SensorScript> read(std::string const& text) {
    write_text(folder_ / "s.json", text);
    return read_sensor_script(folder_ / "s.json");
  }
  /// The one sensor `a` with more keys.
  SensorScript with(std::string const& keys) {
    return read(R"({"sensors": [{"name": "a", "dataset": "d")" + keys + "}]}").at(0);
  }
  SensorScript with_fault(std::string const& fault) {
    return with(R"(, "faults": [)" + fault + "]");
  }

  std::string error(std::string const& text) {
    try {
      read(text);
    } catch (InputError const& error) {
      std::string const what = error.what();
      std::string const folder = folder_.path().string() + "/";
      return what.starts_with(folder) ? what.substr(folder.size()) : what;
    }
    return "no error";
  }
  std::string sensor_error(std::string const& keys) {
    return error(R"({"sensors": [{"name": "a", "dataset": "d")" + keys + "}]}");
  }
  /// Of the second of two faults.
  std::string fault_error(std::string const& fault) {
    std::string const before = "s.json: sensors[0].faults[1]";
    std::string const what =
        sensor_error(R"(, "faults": [{"fault": "forget_settings"}, )" + fault + "]");
    return what.starts_with(before) ? what.substr(before.size()) : what;
  }

  TempFolder folder_;
};

TEST_F(Script, WhatIsNotSaidIsAsUsual) {
  SensorScript const sensor = with("");
  EXPECT_EQ(sensor.name, "a");
  EXPECT_EQ(sensor.dataset, folder_ / "d");
  EXPECT_EQ(sensor.depth_rate_hz, 30.0);
  EXPECT_EQ(sensor.color_rate_hz, 30.0);
  EXPECT_EQ(sensor.play, PlayMode::kLoop);
  EXPECT_EQ(sensor.cache_mb, 256U);
  EXPECT_FALSE(sensor.reports);
  EXPECT_TRUE(sensor.can_register);
  EXPECT_TRUE(sensor.keeps_settings);
  EXPECT_EQ(sensor.start_delay_ns, 0);
  EXPECT_TRUE(sensor.faults.empty());
}

TEST_F(Script, ReadsWhatIsSaid) {
  auto const sensors = read(R"(// two of them
    {"sensors": [{"name": "a-1_b.c", "dataset": "/abs/d", "rate_hz": 15, "play": "ping_pong",
                  "cache_mb": 8, "report": true},
                 {"name": "b", "dataset": "d", "color_rate_hz": 25, "play": "once"}]})");
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_EQ(sensors[0].name, "a-1_b.c");
  EXPECT_EQ(sensors[0].dataset, "/abs/d");
  EXPECT_EQ(sensors[0].depth_rate_hz, 15.0);
  EXPECT_EQ(sensors[0].color_rate_hz, 15.0) << "as depth, where nothing is said";
  EXPECT_EQ(sensors[0].play, PlayMode::kPingPong);
  EXPECT_EQ(sensors[0].cache_mb, 8U);
  EXPECT_TRUE(sensors[0].reports);
  EXPECT_EQ(sensors[1].depth_rate_hz, 30.0);
  EXPECT_EQ(sensors[1].color_rate_hz, 25.0);
  EXPECT_EQ(sensors[1].play, PlayMode::kOnce);
}

TEST_F(Script, TimesAreSecondsOrFrames) {
  Fault const seconds = with_fault(R"({"fault": "stall", "at_s": 1.5, "for_s": 2})").faults.at(0);
  EXPECT_EQ(seconds.kind, FaultKind::kStall);
  EXPECT_EQ(seconds.from_ns, 3 * kSecond_ns / 2);
  EXPECT_EQ(seconds.until_ns, 7 * kSecond_ns / 2);
  EXPECT_TRUE(seconds.depth && seconds.color);
  Fault const frames = with(R"(, "rate_hz": 15, "faults": [{"fault": "stall", "stream": "depth",
                               "at_frame": 1, "for_frames": 2}])")
                           .faults.at(0);
  EXPECT_EQ(frames.from_ns, 66'666'667);
  EXPECT_EQ(frames.until_ns, 200'000'000);
  EXPECT_TRUE(frames.depth && !frames.color);
  Fault const always = with_fault(R"({"fault": "stall", "stream": "color"})").faults.at(0);
  EXPECT_EQ(always.from_ns, 0);
  EXPECT_EQ(always.until_ns, kForever_ns);
  EXPECT_TRUE(!always.depth && always.color);
}

TEST_F(Script, ReadsEachFault) {
  EXPECT_EQ(with_fault(R"({"fault": "unplug", "at_s": 1})").faults.at(0).kind, FaultKind::kUnplug);
  EXPECT_EQ(with_fault(R"({"fault": "registration_ignored"})").faults.at(0).kind,
            FaultKind::kIgnoredRegistration);
  EXPECT_FALSE(with_fault(R"({"fault": "registration_missing"})").can_register);
  Fault const shift = with_fault(R"({"fault": "color_shift", "by_ms": -20})").faults.at(0);
  EXPECT_EQ(shift.kind, FaultKind::kColorShift);
  EXPECT_EQ(shift.shift_ns, -20'000'000);
  Fault const jump = with_fault(R"({"fault": "clock_jump", "at_s": 2, "by_s": -1})").faults.at(0);
  EXPECT_EQ(jump.kind, FaultKind::kClockJump);
  EXPECT_EQ(jump.from_ns, 2 * kSecond_ns);
  EXPECT_EQ(jump.shift_ns, -kSecond_ns);
  EXPECT_EQ(with_fault(R"({"fault": "clock_wrap", "at_s": 2})").faults.at(0).kind,
            FaultKind::kClockWrap);
  for (auto const& [word, how] :
       std::vector<std::pair<std::string, Corruption>>{{"size", Corruption::kSize},
                                                       {"short", Corruption::kShort},
                                                       {"garbage", Corruption::kGarbage}}) {
    Fault const corrupt =
        with_fault(R"({"fault": "corrupt", "seed": 3, "how": ")" + word + "\"}").faults.at(0);
    EXPECT_EQ(corrupt.kind, FaultKind::kCorrupt);
    EXPECT_EQ(corrupt.corruption, how);
    EXPECT_EQ(corrupt.seed, 3U);
  }
  Fault const rate = with_fault(R"({"fault": "rate", "every": 2})").faults.at(0);
  EXPECT_EQ(rate.kind, FaultKind::kRate);
  EXPECT_EQ(rate.every, 2);
  Fault const drop = with_fault(R"({"fault": "drop", "share": 0.1, "seed": 7})").faults.at(0);
  EXPECT_EQ(drop.kind, FaultKind::kDrop);
  EXPECT_EQ(drop.share, 0.1);
  EXPECT_EQ(drop.seed, 7U);
  EXPECT_EQ(with_fault(R"({"fault": "slow_start", "delay_s": 5})").start_delay_ns, 5 * kSecond_ns);
  EXPECT_FALSE(with_fault(R"({"fault": "forget_settings"})").keeps_settings);
}

TEST_F(Script, SaysWhatIsWrongWithTheFile) {
  EXPECT_EQ(error("{\"sensors\":\n  [}"), "s.json:2:4: is not JSON from here on");
  EXPECT_EQ(error(""), "s.json:1:1: is not JSON from here on");
  EXPECT_EQ(error("[]"), "s.json: must be an object with the keys sensors");
  EXPECT_EQ(error(R"({"sensors": []})"), "s.json: sensors: must name at least one sensor");
  EXPECT_EQ(error(R"({"sensors": {}})"), "s.json: sensors: must be a list");
  EXPECT_EQ(error(R"({"sensors": 1e999})"), "s.json: has a number that is too large");
  std::string const none = (folder_ / "none.json").string();
  try {
    read_sensor_script(none);
    FAIL();
  } catch (InputError const& error) {
    EXPECT_EQ(error.what(), none + ": scripts of virtual sensors cannot be read");
  }
}

TEST_F(Script, SaysWhatIsWrongWithASensor) {
  EXPECT_EQ(error(R"({"sensors": [{"dataset": "d"}]})"), "s.json: sensors[0].name: is missing");
  EXPECT_EQ(error(R"({"sensors": [{"name": "a"}]})"), "s.json: sensors[0].dataset: is missing");
  EXPECT_EQ(
      error(R"({"sensors": [{"name": "a b", "dataset": "d"}]})"),
      "s.json: sensors[0].name: must be up to 64 letters, digits, '-', '_' or '.': it is part "
      "of a URI");
  EXPECT_EQ(error(R"({"sensors": [{"name": "a", "dataset": "d"}, {"name": "a", "dataset": "d"}]})"),
            "s.json: sensors[1].name: is taken by a sensor before; give each its own");
  EXPECT_EQ(sensor_error(R"(, "rate": 3)"),
            "s.json: sensors[0]: unknown key 'rate'; the keys are name, dataset, rate_hz, "
            "color_rate_hz, play, cache_mb, report, faults");
  EXPECT_EQ(sensor_error(R"(, "rate_hz": 0)"),
            "s.json: sensors[0].rate_hz: must be in [0.1, 1000] Hz");
  EXPECT_EQ(sensor_error(R"(, "color_rate_hz": "30")"),
            "s.json: sensors[0].color_rate_hz: must be a number");
  EXPECT_EQ(sensor_error(R"(, "play": "loops")"),
            "s.json: sensors[0].play: 'loops' is unknown; known are loop, once, ping_pong");
  EXPECT_EQ(sensor_error(R"(, "cache_mb": 0)"),
            "s.json: sensors[0].cache_mb: must be in [1, 65536] MB");
  EXPECT_EQ(sensor_error(R"(, "report": 1)"), "s.json: sensors[0].report: must be true or false");
}

TEST_F(Script, SaysWhatIsWrongWithAFault) {
  EXPECT_EQ(fault_error("1"), ": must be an object with the key fault");
  EXPECT_EQ(fault_error("{}"), ".fault: is missing");
  EXPECT_EQ(fault_error(R"({"fault": "stal"})"),
            ".fault: 'stal' is unknown; known are clock_jump, clock_wrap, color_shift, corrupt, "
            "drop, forget_settings, rate, registration_ignored, registration_missing, slow_start, "
            "stall, unplug");
  EXPECT_EQ(fault_error(R"({"fault": "stall", "at": 3})"),
            ": unknown key 'at'; the keys are fault, stream, at_s, at_frame, for_s, for_frames");
  EXPECT_EQ(fault_error(R"({"fault": "stall", "at_s": 3, "at_frame": 1})"),
            ": has both at_s and at_frame; give one of them");
  EXPECT_EQ(fault_error(R"({"fault": "stall", "at_s": -1})"),
            ".at_s: must be in [0, 2.6784e+06] s");
  EXPECT_EQ(fault_error(R"({"fault": "stall", "for_frames": 1.5})"),
            ".for_frames: must be a whole number, 0 or above");
  EXPECT_EQ(fault_error(R"({"fault": "stall", "for_s": 0})"),
            ": lasts no time; for_s or for_frames must be above 0");
  EXPECT_EQ(fault_error(R"({"fault": "stall", "stream": "ir"})"),
            ".stream: 'ir' is unknown; known are both, color, depth");
  EXPECT_EQ(fault_error(R"({"fault": "color_shift"})"), ".by_ms: is missing");
  EXPECT_EQ(fault_error(R"({"fault": "color_shift", "by_ms": 1001})"),
            ".by_ms: must be in [-1000, 1000] ms");
  EXPECT_EQ(fault_error(R"({"fault": "clock_jump", "at_s": 2, "by_s": -2.5})"),
            ".by_s: takes the clock back beyond its start; jump less, or later");
  EXPECT_EQ(fault_error(R"({"fault": "corrupt", "how": "bad"})"),
            ".how: 'bad' is unknown; known are garbage, short, size");
  EXPECT_EQ(fault_error(R"({"fault": "rate", "every": 1})"),
            ".every: must be 2 or above: of so many images one comes");
  EXPECT_EQ(fault_error(R"({"fault": "drop", "share": 2})"), ".share: must be in [0, 1]");
  EXPECT_EQ(fault_error(R"({"fault": "slow_start"})"), ".delay_s: is missing");
  EXPECT_EQ(fault_error(R"({"fault": "registration_missing", "at_s": 1})"),
            ": unknown key 'at_s'; the keys are fault");
}

TEST_F(Script, FaultsMustAgreeWithEachOther) {
  std::string const unplug = R"({"fault": "unplug", "at_s": 1, "for_s": 1}, )";
  EXPECT_EQ(sensor_error(R"(, "faults": [)" + unplug + R"({"fault": "unplug", "at_s": 2}])"),
            "s.json: sensors[0].faults[1]: begins before another unplug has ended, or ends as it "
            "begins");
  EXPECT_EQ(with_fault(unplug + R"({"fault": "unplug", "at_s": 2.1})").faults.size(), 2U);
  std::string const wrap = R"({"fault": "clock_wrap", "at_s": 1})";
  EXPECT_EQ(sensor_error(R"(, "faults": [)" + wrap + ", " + wrap + "]"),
            "s.json: sensors[0].faults[1]: the clock wraps again every 71.58 s by itself; say the "
            "first time only");
  // A jump may use up what another has put by, but no more.
  std::string const forward = R"({"fault": "clock_jump", "at_s": 1, "by_s": 5}, )";
  EXPECT_EQ(with_fault(forward + R"({"fault": "clock_jump", "at_s": 2, "by_s": -7})").faults.size(),
            2U);
  EXPECT_EQ(sensor_error(R"(, "faults": [)" + forward +
                         R"({"fault": "clock_jump", "at_s": 2, "by_s": -7.5}])"),
            "s.json: sensors[0].faults[1].by_s: takes the clock back beyond its start; jump less, "
            "or later");
}

}  // namespace
}  // namespace credo::test
