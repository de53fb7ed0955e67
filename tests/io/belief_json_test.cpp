#include "io/belief_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/beliefs.hpp"

namespace credo::test {
namespace {

using Json = nlohmann::json;

TEST(BeliefJson, OfAnEmptyBelief) {
  EXPECT_EQ(belief_json(BeliefSummary()),
            R"({"schema":1,"frame":-1,"stamp_ns":0,"segmented_with":-1,)"
            R"("T_world_camera":[1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0],)"
            R"("floor":null,"walls":[],"objects":[],"stuff":[]})");
}

TEST(BeliefJson, IsTheFormatOfTheFile) {
  EXPECT_EQ(
      belief_json(summary_of(belief_of_a_kitchen())),
      R"({"schema":1,"frame":3,"stamp_ns":100000000,"segmented_with":2,)"
      R"("T_world_camera":[1.0,0.0,0.0,1.0,0.0,1.0,0.0,2.0,0.0,0.0,1.0,1.5,0.0,0.0,0.0,1.0],)"
      R"("floor":{"normal":[0.0,0.0,1.0],"height_m":0.25,"points":2,)"
      R"("probability":0.5,"evidence":"occluded",)"
      R"("log_odds":0.0,"why":{"agrees":10,"occluded":11,"seen_through":12,"no_depth":13,"out_of_view":14,)"
      R"("visible_share":0.5,"news":0.25,"moved":-1.25,"bounded":false}},)"
      R"("walls":[{"id":4,"segment":[[5.0,-1.0],[5.0,1.5]],"normal":[-1.0,-0.0,-0.0],)"
      R"("points":1,"label":2001,"probability":0.5,"evidence":"out_of_view",)"
      R"("log_odds":0.0,"why":{"agrees":20,"occluded":21,"seen_through":22,"no_depth":23,"out_of_view":24,)"
      R"("visible_share":0.5,"news":0.25,"moved":-2.5,"bounded":false}}],)"
      R"("objects":[{"id":"box_1","type":"box","probability":0.5,"position":[2.0,0.0,0.5],)"
      R"("orientation_xyzw":[0.0,0.0,1.0,0.0],"covariance":[1.0,0.0,0.0,0.0,0.0,0.0,)"
      R"(0.0,2.0,0.0,0.0,0.0,0.0,0.0,0.0,3.0,0.0,0.0,0.0,0.0,0.0,0.0,4.0,0.0,0.0,)"
      R"(0.0,0.0,0.0,0.0,5.0,0.0,0.0,0.0,0.0,0.0,0.0,6.0],)"
      R"("evidence":"seen_through","label":null,)"
      R"("log_odds":0.0,"why":{"agrees":30,"occluded":31,"seen_through":32,"no_depth":33,"out_of_view":34,)"
      R"("visible_share":0.5,"news":0.25,"moved":-3.75,"bounded":true}}],)"
      R"("stuff":[{"id":7,"probability":0.5,"history":3,"points":421,"centroid":[2.0,1.0,0.5],)"
      R"("min":[1.5,0.5,0.0],"max":[2.5,1.5,1.0],"evidence":"seen","label":4003,)"
      R"("log_odds":0.0,"why":{"agrees":40,"occluded":41,"seen_through":42,"no_depth":43,"out_of_view":44,)"
      R"("visible_share":0.5,"news":0.25,"moved":-5.0,"bounded":true}}]})");
}

TEST(BeliefJson, WhatBecameOneWithAThingIsToldOfIt) {
  BeliefState belief = belief_of_a_kitchen();
  EXPECT_FALSE(Json::parse(belief_json(summary_of(belief)))["stuff"][0].contains("joined"));
  belief.stuff[0].joined_ids = {3, 5};
  EXPECT_EQ(Json::parse(belief_json(summary_of(belief)))["stuff"][0]["joined"], Json({3, 5}));
}

TEST(BeliefJson, NumbersReadBackToTheBit) {
  BeliefState belief = belief_of_a_kitchen();
  belief.floor->height_m = std::nextafter(0.1, 1.0);
  belief.stamp_ns = std::numeric_limits<std::int64_t>::max();
  auto cluster = std::make_shared<StuffCluster>(belief.stuff[0].latest());
  cluster->centroid_world = {0.1F, -1.0F / 3.0F, 1e-30F};
  belief.stuff[0].recent_clusters = {cluster};
  Json const json = Json::parse(belief_json(summary_of(belief)));
  EXPECT_EQ(json["floor"]["height_m"].get<double>(), belief.floor->height_m);
  EXPECT_EQ(json["stamp_ns"].get<std::int64_t>(), belief.stamp_ns);
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_EQ(json["stuff"][0]["centroid"][static_cast<std::size_t>(i)].get<float>(),
              cluster->centroid_world(i));
  }
}

TEST(BeliefJson, PosesKeepTheConventions) {
  BeliefState belief = belief_of_a_kitchen();
  // A quarter turn about z: x_camera points along y_world.
  Eigen::Quaterniond const turned(
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  belief.T_world_camera = Se3(turned, {7, 8, 9});
  belief.objects[0].pose_world.mean = Se3(turned, {7, 8, 9});
  Matrix6d& covariance = belief.objects[0].pose_world.covariance;
  covariance(0, 5) = 0.25 + 1e-12;
  covariance(5, 0) = 0.25;
  Json const json = Json::parse(belief_json(summary_of(belief)));

  auto const matrix = json["T_world_camera"].get<std::vector<double>>();
  ASSERT_EQ(matrix.size(), 16U);
  EXPECT_NEAR(matrix[4], 1.0, 1e-12) << "row 1, column 0";
  EXPECT_EQ(matrix[3], 7.0);
  EXPECT_EQ(matrix[11], 9.0);
  EXPECT_THAT(std::vector<double>(matrix.begin() + 12, matrix.end()),
              testing::ElementsAre(0, 0, 0, 1));

  auto const q = json["objects"][0]["orientation_xyzw"].get<std::vector<double>>();
  EXPECT_NEAR(q[2], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(q[3], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])), 1.0, 1e-6);
  auto const c = json["objects"][0]["covariance"].get<std::vector<double>>();
  ASSERT_EQ(c.size(), 36U);
  EXPECT_EQ(c[5], c[30]);
  EXPECT_NEAR(c[5], 0.25, 1e-11);
}

TEST(BeliefJson, CertaintyAndEveryEvidenceHaveTheirWords) {
  BeliefState belief = belief_of_a_kitchen();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  belief.objects[0].log_odds = -kInfinity;
  belief.stuff[0].log_odds = kInfinity;
  Json json = Json::parse(belief_json(summary_of(belief)));
  EXPECT_EQ(json["objects"][0]["probability"], 0.0);
  EXPECT_EQ(json["stuff"][0]["probability"], 1.0);
  EXPECT_EQ(json["stuff"][0]["log_odds"], nullptr) << "JSON has no infinity";
  std::vector<std::string> words;
  for (Evidence const evidence : {Evidence::kSeen, Evidence::kSeenThrough, Evidence::kOccluded,
                                  Evidence::kOutOfView, Evidence::kNotSeen}) {
    belief.stuff[0].evidence = evidence;
    words.push_back(Json::parse(belief_json(summary_of(belief)))["stuff"][0]["evidence"]);
  }
  EXPECT_THAT(words,
              testing::ElementsAre("seen", "seen_through", "occluded", "out_of_view", "not_seen"));
}

TEST(BeliefJson, IdsOfAnyCharactersStayOneLineOfJson) {
  BeliefState belief = belief_of_a_kitchen();
  belief.objects[0].id =
      "a \"box\"\n\\ K\xC3\xBC"
      "che";
  std::string const line = belief_json(summary_of(belief));
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(Json::parse(line)["objects"][0]["id"], belief.objects[0].id);
  belief.objects[0].id = "Latin-1: \xFC";
  EXPECT_EQ(Json::parse(belief_json(summary_of(belief)))["objects"][0]["id"],
            "Latin-1: \xEF\xBF\xBD");
}

}  // namespace
}  // namespace credo::test
