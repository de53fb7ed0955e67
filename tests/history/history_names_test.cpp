#include "history/history_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "history/history.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<ThingHistory> things(std::vector<std::pair<ThingKind, std::string>> const& ids) {
  std::vector<ThingHistory> histories;
  for (auto const& [kind, id] : ids) {
    histories.push_back({kind, thing_name(kind, id), "", {}, {}, ""});
  }
  return histories;
}

std::vector<ThingHistory> a_room() {
  return things({{ThingKind::kFloorPlane, ""},
                 {ThingKind::kWallPlane, "2"},
                 {ThingKind::kObject, "box_1"},
                 {ThingKind::kObject, "7"},
                 {ThingKind::kObject, "floor"},
                 {ThingKind::kStuff, "7"},
                 {ThingKind::kStuff, "12"},
                 {ThingKind::kStuff, "30"}});
}

std::string found(std::vector<ThingHistory> const& histories, std::string const& name) {
  ThingHistory const* history = find_thing(histories, name);
  return history == nullptr ? "none" : history->name;
}

TEST(Names, OfObjectsAreTheirIdsUnlessTheseMeanSomethingElse) {
  for (char const* plain : {"box_1", "the wall:", "floor_lamp", "7up", "stuff"}) {
    EXPECT_EQ(thing_name(ThingKind::kObject, plain), plain);
  }
  for (char const* other : {"floor", "7", "wall:1", "stuff:x", "object:a"}) {
    EXPECT_EQ(thing_name(ThingKind::kObject, other), std::string("object:") + other);
  }
}

TEST(Names, FindWhatTheyMean) {
  std::vector<ThingHistory> const room = a_room();
  EXPECT_EQ(found(room, "floor"), "floor");
  EXPECT_EQ(found(room, "wall:2"), "wall:2");
  EXPECT_EQ(found(room, "box_1"), "box_1");
  EXPECT_EQ(found(room, "object:box_1"), "box_1");
  EXPECT_EQ(found(room, "7"), "stuff:7") << "a bare number is stuff";
  EXPECT_EQ(found(room, "object:7"), "object:7");
  EXPECT_EQ(found(room, "object:floor"), "object:floor");
  EXPECT_EQ(found(room, "stuff:12"), "stuff:12");
}

TEST(Names, ThatMeanNothingFindNothing) {
  std::vector<ThingHistory> const room = a_room();
  for (char const* name : {"", "8", "stuff:8", "wall:7", "object:12", "object:wall:2", "box"}) {
    EXPECT_EQ(found(room, name), "none") << name;
  }
  EXPECT_EQ(found(things({{ThingKind::kObject, "7"}}), "7"), "object:7")
      << "where no stuff has that number";
  EXPECT_EQ(found(things({{ThingKind::kFloorPlane, ""}}), "object:floor"), "none");
}

TEST(Names, ThatAreNearComeFirst) {
  EXPECT_THAT(near_names(a_room(), "11", 3), ElementsAre("stuff:12", "stuff:7", "stuff:30"));
  EXPECT_THAT(near_names(a_room(), "stuff:29", 1), ElementsAre("stuff:30"));
  EXPECT_THAT(near_names(a_room(), "wall:30", 1), ElementsAre("wall:2"));
  EXPECT_THAT(near_names(a_room(), "bix_1", 1), ElementsAre("box_1"));
  EXPECT_THAT(near_names(a_room(), "flor", 1), ElementsAre("floor"));
  EXPECT_EQ(near_names(a_room(), "x", 100).size(), 8U);
  EXPECT_THAT(near_names({}, "x", 3), IsEmpty());
}

}  // namespace
}  // namespace credo::test
