#include "dds/detection_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "dds/responder.hpp"

namespace credo::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Three by two pixels, one without depth.
Frame small_frame() {
  Frame frame;
  frame.index = FrameIndex{7};
  frame.stamp_ns = 123456789;
  frame.intrinsics = {500.5, 501.5, 1.25, 0.75};
  frame.cloud_camera = OrganizedCloud(3, 2);
  for (std::size_t i = 0; i < 5; ++i) {
    frame.cloud_camera.set(i, {9.0F, 8.0F, 1.0F + 0.1F * static_cast<float>(i)});
  }
  frame.color = Grid<Rgb>(3, 2);
  for (std::size_t i = 0; i < 6; ++i) {
    auto const value = static_cast<std::uint8_t>(10 * i);
    frame.color[i] = {value, static_cast<std::uint8_t>(value + 1),
                      static_cast<std::uint8_t>(value + 2)};
  }
  frame.color_registered = true;
  return frame;
}

DetectionSession const kSession{"robot", 42};

template <typename Sequence>
auto values(Sequence const& sequence) {
  return std::vector(sequence._buffer, sequence._buffer + sequence._length);
}

TEST(DetectionRequestMessage, TellsWhoAsksOfWhichFrame) {
  Frame const frame = small_frame();
  DetectionRequestMessage const message(kSession, frame, {});
  credo_msg_DetectionRequest const& sample = message.sample();
  EXPECT_STREQ(sample.source, "robot");
  EXPECT_EQ(sample.session, 42U);
  EXPECT_EQ(sample.schema_version, 1U);
  EXPECT_EQ(sample.frame, 7);
  EXPECT_EQ(sample.stamp_ns, 123456789);
  EXPECT_EQ(sample.fx_px, 500.5);
  EXPECT_EQ(sample.fy_px, 501.5);
  EXPECT_EQ(sample.cx_px, 1.25);
  EXPECT_EQ(sample.cy_px, 0.75);
  EXPECT_THAT(values(sample.objects), IsEmpty());
}

TEST(DetectionRequestMessage, ImagesAreRowByRow) {
  Frame const frame = small_frame();
  DetectionRequestMessage const message(kSession, frame, {});
  credo_msg_DetectionRequest const& sample = message.sample();
  EXPECT_EQ(sample.width_px, 3U);
  EXPECT_EQ(sample.height_px, 2U);
  EXPECT_THAT(values(sample.depth_m), ElementsAre(1.0F, 1.1F, 1.2F, 1.3F, 1.4F, testing::IsNan()));
  EXPECT_THAT(values(sample.color_rgb),
              ElementsAre(0, 1, 2, 10, 11, 12, 20, 21, 22, 30, 31, 32, 40, 41, 42, 50, 51, 52));
  EXPECT_TRUE(sample.color_registered);
}

TEST(DetectionRequestMessage, AFrameWithoutColourHasNone) {
  Frame frame = small_frame();
  frame.color_registered = false;
  EXPECT_FALSE(DetectionRequestMessage(kSession, frame, {}).sample().color_registered);
  frame.color = {};
  frame.color_registered = true;
  DetectionRequestMessage const message(kSession, frame, {});
  EXPECT_EQ(message.sample().color_rgb._length, 0U);
  EXPECT_FALSE(message.sample().color_registered);
}

TEST(DetectionRequestMessage, ColourOfAnotherSizeIsRefused) {
  Frame frame = small_frame();
  for (auto const& [width, height] : {std::pair(2, 3), std::pair(3, 1), std::pair(1, 2)}) {
    frame.color = Grid<Rgb>(width, height);
    EXPECT_THROW(DetectionRequestMessage(kSession, frame, {}), std::logic_error);
  }
}

TEST(DetectionRequestMessage, TellsWhatIsLookedForAndWhere) {
  Frame const frame = small_frame();
  std::vector<DetectionRequest> const requests = {{"cup_1", "cup", some_pose(0.1)},
                                                  {"table_1", "table", some_pose(0.2)}};
  DetectionRequestMessage const message(kSession, frame, requests);
  std::vector<credo_msg_WantedObject> const wanted = values(message.sample().objects);
  ASSERT_EQ(wanted.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(wanted[i].object_id, requests[i].object_id);
    EXPECT_EQ(wanted[i].type, requests[i].type);
    credo_msg_CameraPose const expected = camera_pose_message(requests[i].expected_camera);
    EXPECT_THAT(wanted[i].expected.position_camera_m,
                testing::ElementsAreArray(expected.position_camera_m));
    EXPECT_THAT(wanted[i].expected.orientation_camera_xyzw,
                testing::ElementsAreArray(expected.orientation_camera_xyzw));
    EXPECT_THAT(wanted[i].expected.covariance, testing::ElementsAreArray(expected.covariance));
  }
}

std::vector<Detection> read(Reply reply) {
  std::vector<Detection> detections;
  reply.lend([&](auto const& message) { detections = detections_in(message); });
  return detections;
}

/// To frame 3, with two detections.
Reply two_found() {
  Reply reply;
  reply.frame = 3;
  reply.detections = {{"cup", some_pose(0.1), -2.5, 0.0}, {"table", some_pose(0.2), 0.9, 1.0}};
  return reply;
}

TEST(DetectionsIn, AreWhatTheReplyWasMadeOf) {
  Reply const reply = two_found();
  std::vector<Detection> const found = read(reply);
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    Detection const& expected = reply.detections[i];
    EXPECT_EQ(found[i].type, expected.type);
    EXPECT_EQ(found[i].score, expected.score);
    EXPECT_EQ(found[i].visible_fraction, expected.visible_fraction);
    EXPECT_EQ(found[i].pose_camera.covariance, expected.pose_camera.covariance);
    EXPECT_EQ(found[i].pose_camera.mean.translation(), expected.pose_camera.mean.translation());
    EXPECT_TRUE(
        found[i].pose_camera.mean.rotation().isApprox(expected.pose_camera.mean.rotation(), 1e-15));
  }
  EXPECT_THAT(read(Reply()), IsEmpty());
}

TEST(DetectionsIn, ADetectorThatCouldNotLookDidNotLook) {
  Reply reply = two_found();
  reply.error = "out of memory";
  try {
    (void)read(reply);
    FAIL() << "it looked";
  } catch (NobodyLooked const& error) {
    EXPECT_STREQ(error.what(), "the detector says: out of memory");
  }
}

std::string refusal_of(Reply const& reply) {
  try {
    (void)read(reply);
  } catch (NobodyLooked const&) {
    return "nobody looked";
  } catch (std::runtime_error const& error) {
    return error.what();
  }
  return "taken";
}

TEST(DetectionsIn, AnotherSchemaIsRefused) {
  for (std::uint32_t const version : {0U, 2U}) {
    Reply reply = two_found();
    reply.schema_version = version;
    // What else it says may mean something else.
    reply.error = "an error";
    EXPECT_EQ(refusal_of(reply), "the detector's reply to frame 3 has schema " +
                                     std::to_string(version) +
                                     ", and this Credo reads 1: build both with the same "
                                     "idl/credo/detector.idl");
  }
}

/// Why a reply is refused whose second detection was spoilt.
std::string spoilt(std::function<void(Detection&)> const& spoil) {
  Reply reply = two_found();
  spoil(reply.detections[1]);
  std::string const refusal = refusal_of(reply);
  std::string const place = "the detector's reply to frame 3: detections[1] (";
  EXPECT_EQ(refusal.substr(0, place.size()), place);
  return refusal.substr(std::min(place.size(), refusal.size()));
}

TEST(DetectionsIn, WhatCannotBeIsRefused) {
  EXPECT_EQ(spoilt([](Detection& d) { d.type.clear(); }), "): type must not be empty");
  for (double const wrong : {kNotANumber, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(spoilt([&](Detection& d) { d.score = wrong; }), "table): score must be finite");
  }
  for (double const wrong : {kNotANumber, -0.01, 1.01}) {
    EXPECT_EQ(spoilt([&](Detection& d) { d.visible_fraction = wrong; }),
              "table): visible_fraction must be in [0, 1]");
  }
  for (double const wrong : {kNotANumber, 1e5, -1e5}) {
    EXPECT_EQ(spoilt([&](Detection& d) {
                d.pose_camera.mean = Se3(Eigen::Quaterniond::Identity(), {0.0, wrong, 0.0});
              }),
              "table): position_camera_m must be within 10000 m");
  }
}

TEST(DetectionsIn, CovariancesThatAreNoneAreRefused) {
  std::string const none = "table): covariance must be symmetric and positive definite";
  auto const with = [](int row, int column, double value) {
    return spoilt([=](Detection& d) { d.pose_camera.covariance(row, column) = value; });
  };
  EXPECT_EQ(with(2, 2, -1.0), none);
  EXPECT_EQ(with(2, 2, 0.0), none);
  EXPECT_EQ(with(0, 1, 0.1), none) << "not symmetric";
  EXPECT_EQ(with(5, 0, kNotANumber), none);
  EXPECT_EQ(with(3, 3, kNotANumber), none);
  std::string const beyond =
      "table): covariance must have standard deviations in [1e-6, 1000] m and rad";
  EXPECT_EQ(with(5, 5, 1e-13), beyond);
  EXPECT_EQ(with(5, 5, 1e7), beyond);
}

TEST(DetectionsIn, ATurnThatIsNoneIsRefused) {
  Reply reply = two_found();
  for (double const scale : {0.0, 0.5, 1.02, kNotANumber}) {
    reply.lend([&](credo_msg_DetectionReply const& message) {
      for (double& part : message.detections._buffer[0].pose.orientation_camera_xyzw) {
        part *= scale;
      }
      try {
        (void)detections_in(message);
        ADD_FAILURE() << scale;
      } catch (std::runtime_error const& error) {
        EXPECT_THAT(
            error.what(),
            testing::HasSubstr("[0] (cup): orientation_camera_xyzw must be of length 1, has "));
      }
    });
  }
}

}  // namespace
}  // namespace credo::test
