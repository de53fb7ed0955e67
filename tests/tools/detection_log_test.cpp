#include "tools/detection_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace credo::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr char const* kLast = " (more of these are only counted)";

RefusedDetection refused(std::string type, std::string object_id, double squared_distance,
                         double max_squared_distance = 22.46) {
  return {std::move(type),
          std::move(object_id),
          {Se3(Eigen::Quaterniond::Identity(), {1.234, -0.5, 12}), {}},
          squared_distance,
          max_squared_distance};
}
RefusedDetection far_from(std::string object_id) {
  return refused("box", std::move(object_id), 99.0);
}
RefusedDetection of_no_object(std::string type) {
  return refused(std::move(type), "", std::numeric_limits<double>::infinity());
}

Segmentation frame_of(std::int64_t index, std::vector<RefusedDetection> refusals,
                      std::size_t taken = 0) {
  Segmentation segmentation;
  segmentation.frame = FrameIndex{index};
  segmentation.objects_looked_for = true;
  segmentation.refused = std::move(refusals);
  segmentation.objects.resize(taken);
  return segmentation;
}

TEST(DetectionLog, TellsWhyADetectionWasRefused) {
  DetectionLog log;
  EXPECT_THAT(
      log.told(frame_of(
          7, {refused("box", "box_1", 31.36), refused("box", "box_1", 3.0), of_no_object("can")})),
      ElementsAre("frame 7: a box detected at (1.23, -0.50, 12.00) m is not taken for box_1: "
                  "squared Mahalanobis distance 31.4, the gate lets pass 22.5",
                  "frame 7: a box detected at (1.23, -0.50, 12.00) m is not taken for box_1: "
                  "another detection fits better",
                  "frame 7: a can detected at (1.23, -0.50, 12.00) m is no object of the belief"));
}

TEST(DetectionLog, OnTheGatesEdgeADetectionWasWithinIt) {
  DetectionLog log;
  EXPECT_THAT(log.told(frame_of(0, {refused("box", "box_1", 22.46, 22.46)})),
              ElementsAre(EndsWith("another detection fits better")));
}

TEST(DetectionLog, FramesWithoutRefusalsAreSilent) {
  DetectionLog log;
  EXPECT_THAT(log.told(frame_of(0, {}, 2)), IsEmpty());
}

TEST(DetectionLog, OnlyTheFirstFiveOfAnObjectAreTold) {
  DetectionLog log;
  for (int i = 0; i < 4; ++i) {
    EXPECT_THAT(log.told(frame_of(i, {far_from("box_1")})), ElementsAre(Not(EndsWith(kLast))));
  }
  EXPECT_THAT(log.told(frame_of(4, {far_from("box_1")})), ElementsAre(EndsWith(kLast)));
  for (int i = 5; i < 12; ++i) {
    EXPECT_THAT(log.told(frame_of(i, {far_from("box_1")})), IsEmpty());
  }
  EXPECT_EQ(log.summary(), "objects: 0 detections taken, 12 refused (12 box_1)\n");
}

TEST(DetectionLog, AnObjectThatIsOnlyCountedHushesNoOther) {
  DetectionLog log;
  std::vector<RefusedDetection> const many(9, far_from("box_1"));
  EXPECT_THAT(log.told(frame_of(0, many)), SizeIs(5));
  EXPECT_THAT(log.told(frame_of(1, {far_from("box_1"), far_from("box_2"), of_no_object("can")})),
              ElementsAre(Not(EndsWith(kLast)), Not(EndsWith(kLast))));
}

TEST(DetectionLog, WhatIsOfNoObjectCountsTogether) {
  DetectionLog log;
  std::vector<RefusedDetection> const cans(4, of_no_object("can"));
  EXPECT_THAT(log.told(frame_of(0, cans)), SizeIs(4));
  EXPECT_THAT(log.told(frame_of(1, {of_no_object("cup"), of_no_object("jug")})),
              ElementsAre(EndsWith(kLast)));
}

TEST(DetectionLog, SumsUpOverAllFrames) {
  DetectionLog log;
  (void)log.told(frame_of(0, {far_from("table_1"), of_no_object("can")}, 2));
  (void)log.told(frame_of(1, {far_from("table_1"), far_from("box_1")}, 1));
  EXPECT_EQ(log.summary(),
            "objects: 3 detections taken, 4 refused (1 of no object, 1 box_1, 2 table_1)\n");
}

TEST(DetectionLog, WithoutRefusalsNoneAreListed) {
  DetectionLog log;
  (void)log.told(frame_of(0, {}, 2));
  EXPECT_EQ(log.summary(), "objects: 2 detections taken, 0 refused\n");
}

TEST(DetectionLog, SaysNothingWhereNobodyLooked) {
  DetectionLog log;
  EXPECT_EQ(log.summary(), "");
  Segmentation blind = frame_of(0, {});
  blind.objects_looked_for = false;
  EXPECT_THAT(log.told(blind), IsEmpty());
  EXPECT_EQ(log.summary(), "");
}

TEST(DetectionLog, OneFrameThatWasLookedAtIsEnoughToSumUp) {
  DetectionLog log;
  (void)log.told(frame_of(0, {}));
  Segmentation blind = frame_of(1, {});
  blind.objects_looked_for = false;
  (void)log.told(blind);
  EXPECT_EQ(log.summary(),
            "objects: 0 detections taken, 0 refused; nobody looked in 1 of 2 frames\n");
}

}  // namespace
}  // namespace credo::test
