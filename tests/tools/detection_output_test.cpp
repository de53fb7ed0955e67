#include "tools/detection_output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

Detection cup() {
  Detection detection;
  detection.type = "cup";
  detection.pose_camera.mean =
      Se3(Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ())),
          {0.125, -0.25, 1.5});
  Matrix6d& covariance = detection.pose_camera.covariance;
  covariance.diagonal() << 1e-6, 4e-6, 2.5e-7, 1e-4, 4e-4, 2.5e-3;
  covariance(0, 5) = covariance(5, 0) = 7e-7;
  covariance(1, 2) = covariance(2, 1) = -3e-7;
  detection.score = 0.75;
  detection.visible_fraction = 0.5;
  return detection;
}

ObjectModels two_models() {
  ObjectModels models;
  models["cup"].name = "cup";
  models["bowl"].name = "bowl";
  return models;
}

std::vector<std::string> lines(std::string const& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    all.push_back(line);
  }
  return all;
}

TEST(DetectionsJson, TellsEachInMetresAndRadians) {
  std::string const text = detections_json({cup()});
  EXPECT_EQ(text.back(), '\n');
  EXPECT_THAT(text.substr(0, text.size() - 1), Not(HasSubstr("\n")));
  Json const list = Json::parse(text);
  ASSERT_EQ(list.size(), 1U);
  std::vector<std::string> keys;
  for (auto const& [key, value] : list[0].items()) {
    keys.push_back(key);
  }
  EXPECT_THAT(keys, ElementsAre("type", "position", "orientation_xyzw", "score", "visible_fraction",
                                "covariance"));
  EXPECT_EQ(list[0]["type"], "cup");
  EXPECT_EQ(list[0]["position"], (Json{0.125, -0.25, 1.5}));
  EXPECT_NEAR(list[0]["orientation_xyzw"][0].get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(list[0]["orientation_xyzw"][2].get<double>(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(list[0]["orientation_xyzw"][3].get<double>(), std::sqrt(0.5), 1e-12);
  EXPECT_EQ(list[0]["score"], 0.75);
  EXPECT_EQ(list[0]["visible_fraction"], 0.5);
}

TEST(DetectionsJson, CovariancesAreRowByRow) {
  Detection detection = cup();
  // Told as it is, row by row, also where it is not symmetric.
  detection.pose_camera.covariance(0, 1) = 5e-7;
  Json const covariance = Json::parse(detections_json({detection}))[0]["covariance"];
  ASSERT_EQ(covariance.size(), 36U);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      EXPECT_EQ(covariance[static_cast<std::size_t>(6 * row + column)],
                detection.pose_camera.covariance(row, column));
    }
  }
}

TEST(DetectionsJson, OfNothingIsAnEmptyList) {
  EXPECT_EQ(detections_json({}), "[]\n");
}

TEST(DetectionsJson, KeepsTheOrder) {
  Detection other = cup();
  other.type = "bowl";
  Json const list = Json::parse(detections_json({cup(), other, cup()}));
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[1]["type"], "bowl");
}

TEST(DetectionTable, HasALineForEachModel) {
  std::vector<std::string> const table = lines(detection_table(two_models(), {cup()}));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_THAT(table[0], StartsWith("object"));
  EXPECT_THAT(table[0], HasSubstr("probability"));
  EXPECT_THAT(table[1], StartsWith("bowl"));
  EXPECT_THAT(table[1], HasSubstr("not found"));
  EXPECT_THAT(table[2], StartsWith("cup"));
  std::istringstream words(table[2]);
  std::vector<std::string> const told{std::istream_iterator<std::string>(words), {}};
  // Largest deviations: 2 mm, and 0.05 rad.
  EXPECT_THAT(told, ElementsAre("cup", "0.750", "50%", "0.125", "-0.250", "1.500", "2.0", "2.9"));
  EXPECT_EQ(table[2].size(), table[0].size()) << "columns stand under their names";
}

TEST(DetectionTable, TwoOfOneTypeAreTwoLines) {
  Detection second = cup();
  second.score = 0.6;
  std::vector<std::string> const table = lines(detection_table(two_models(), {cup(), second}));
  ASSERT_EQ(table.size(), 4U);
  EXPECT_THAT(table[2], HasSubstr("0.750"));
  EXPECT_THAT(table[3], HasSubstr("0.600"));
}

TEST(DetectionTable, WhatNobodyAskedForIsNotTold) {
  Detection ghost = cup();
  ghost.type = "ghost";
  EXPECT_THAT(detection_table(two_models(), {ghost}), Not(HasSubstr("ghost")));
  EXPECT_EQ(lines(detection_table({}, {})).size(), 1U);
}

}  // namespace
}  // namespace credo::test
