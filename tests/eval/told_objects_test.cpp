#include "eval/told_objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Eq;
using ::testing::Optional;

ObjectSummary believed(char const* id, char const* type, double x) {
  ObjectSummary object;
  object.id = id;
  object.type = type;
  object.position_m = {x, 0, 0};
  return object;
}

TrueThing thing(char const* id, char const* type, double x) {
  TrueThing result;
  result.id = id;
  result.type = type;
  result.pose = Se3(Eigen::Quaterniond::Identity(), {x, 0, 0});
  return result;
}

TEST(ToldObjects, NearestPairsOfOneTypeFirst) {
  BeliefSummary belief;
  belief.objects = {believed("a", "box", 0.0), believed("b", "box", 1.0), believed("c", "cup", 1)};
  FrameTruth truth;
  truth.objects = {thing("1", "box", 0.9), thing("2", "box", 2.5), thing("3", "box", 9),
                   thing("4", "pan", 1.0)};
  ToldObjects const told(belief, truth);
  EXPECT_TRUE(told.told("1"));
  EXPECT_TRUE(told.told("2")) << "a is left with the farther one";
  EXPECT_FALSE(told.told("3"));
  EXPECT_FALSE(told.told("4"));
  EXPECT_THAT(told.match(belief, truth), ElementsAre(Optional(1U), Optional(0U), Eq(std::nullopt)));
}

TEST(ToldObjects, WhoeverWasNotToldOfIsNeverMeantLater) {
  BeliefSummary belief;
  belief.objects = {believed("a", "box", 0.0)};
  FrameTruth truth;
  truth.objects = {thing("1", "box", 0.1), thing("2", "box", 5.0)};
  ToldObjects const told(belief, truth);
  belief.objects[0].position_m.x() = 5.0;
  EXPECT_THAT(told.match(belief, truth), ElementsAre(Optional(0U)));
}

}  // namespace
}  // namespace credo::test
