#include <gtest/gtest.h>

#include "doctor/finding_matchers.hpp"
#include "doctor/image_times.hpp"
#include "doctor/sensor_findings.hpp"

namespace credo::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

/// A sensor without fault, over three seconds.
SensorMeasurement healthy() {
  SensorMeasurement measured;
  measured.uri = "virtual://a";
  measured.has_color = true;
  measured.depth_rate_hz = 30;
  measured.color_rate_hz = 30;
  measured.waited_s = 0.8;
  measured.measured_s = 3.0;
  measured.depth = image_times(30.0, 91);
  measured.color = image_times(30.0, 91);
  return measured;
}

std::vector<ImageTime> every(std::vector<ImageTime> const& images, std::size_t step) {
  std::vector<ImageTime> some;
  for (std::size_t i = 0; i < images.size(); i += step) {
    some.push_back(images[i]);
  }
  return some;
}

TEST(StreamFindings, AllIsWell) {
  auto const findings = stream_findings(healthy());
  EXPECT_THAT(troubles(findings), IsEmpty());
  EXPECT_THAT(findings,
              ElementsAre(ok("first depth image", "0.8 s"),
                          ok("depth rate",
                             "30.0 images/s by arrival, 30.0 by its stamps, 30 by "
                             "its mode; longest gap 33 ms"),
                          ok("depth lost", "0 of 91"), ok("colour rate"), ok("colour lost"),
                          ok("sync", "100 % of the depth images"), ok("clock", "0 ppm")));
}

TEST(StreamFindings, HalfTheRate) {
  SensorMeasurement measured = healthy();
  measured.depth = every(measured.depth, 2);
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("depth rate", "15.0 images/s by arrival", "another USB socket"),
                          warning("depth lost", "45 of 91 by their numbers", "see depth rate")));
}

TEST(StreamFindings, HardlyAnyImages) {
  SensorMeasurement measured = healthy();
  measured.depth = every(measured.depth, 10);
  EXPECT_THAT(stream_findings(measured), Contains(error("depth rate", "3.0 images/s")));
}

// At the ends of what is said to be well.
TEST(StreamFindings, LittleIsNoFault) {
  SensorMeasurement measured = healthy();
  measured.depth.erase(measured.depth.begin() + 40);
  measured.waited_s = 2.9;
  measured.color = shifted(measured.color, 4.9);
  EXPECT_THAT(troubles(stream_findings(measured)), IsEmpty());
  measured.depth.erase(measured.depth.begin() + 50);
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("depth lost", "2 of 91", "another USB socket")));
}

TEST(StreamFindings, ColourAtHalfTheRate) {
  SensorMeasurement measured = healthy();
  measured.color = every(measured.color, 2);
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("colour rate", "15.0 images/s"), warning("colour lost", "45"),
                          warning("sync", "51 % of the depth images")));
}

TEST(StreamFindings, ColourOfAnotherMoment) {
  SensorMeasurement measured = healthy();
  measured.color = shifted(measured.color, -12.0);
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("sync", "colour is 12.0 ms before depth (median)", "12 mm")));
}

TEST(StreamFindings, NoColour) {
  SensorMeasurement measured = healthy();
  measured.color.clear();
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("colour", "not one image in 3.0 s")));
  measured.has_color = false;
  measured.warnings = {"openni:a: has no colour of the size of its depth"};
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("colour", "none of the size of its depth")));
}

TEST(StreamFindings, ASettingThatIsNotTaken) {
  SensorMeasurement measured = healthy();
  measured.warnings = {"openni:a: does not take sensor.gain"};
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("settings", "does not take sensor.gain")));
}

TEST(StreamFindings, ASlowStart) {
  SensorMeasurement measured = healthy();
  measured.waited_s = 4.0;
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(warning("first depth image", "4.0 s after", "sensor.first_frame_s")));
}

TEST(StreamFindings, NothingAtAll) {
  SensorMeasurement measured = healthy();
  measured.depth.clear();
  measured.color.clear();
  measured.waited_s = 10.0;
  EXPECT_THAT(stream_findings(measured),
              ElementsAre(error("first depth image", "none in 10.0 s", "unplug")));
  measured.unplugged = true;
  EXPECT_THAT(stream_findings(measured),
              ElementsAre(error("first depth image", "went before one came")));
}

TEST(StreamFindings, BrokenImagesAndALooseContact) {
  SensorMeasurement measured = healthy();
  measured.broken = 2;
  measured.broken_why = "a depth image of 320x240 pixels in 100 bytes";
  measured.unplugged = true;
  EXPECT_THAT(troubles(stream_findings(measured)),
              ElementsAre(error("depth images", "2 were not whole, as a depth image of 320x240"),
                          error("connection", "went while", "dmesg")));
}

TEST(StreamFindings, AClockThatIsWrongOrJumps) {
  SensorMeasurement measured = healthy();
  for (ImageTime& image : measured.depth) {
    image.stamp_ns -= image.stamp_ns / 200;
  }
  EXPECT_THAT(stream_findings(measured),
              Contains(warning("clock", "5000 ppm slower", "--seconds 20")));
  // That much may be the images' coming late.
  for (ImageTime& image : measured.depth) {
    image.stamp_ns += image.stamp_ns / 250;
  }
  EXPECT_THAT(stream_findings(measured), Contains(ok("clock", "1020 ppm slower")));
  measured.clock_jumps = 2;
  EXPECT_THAT(stream_findings(measured), Contains(warning("clock", "jumped 2 times")));
}

}  // namespace
}  // namespace credo::test
