// Values that may be written in more ways than one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/kitchen_config.hpp"
#include "support/yaml_file.hpp"

namespace credo::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Has one member, so its name may be left out.
struct Stop {
  std::vector<double> at_m;
};
FieldList fields(Stop& stop) {
  return {{"at", NumbersTarget{&stop.at_m, 2, 2}, {-9, 9}, "m", "where to halt"}};
}

/// One field of every kind that can be written in several ways.
struct RouteConfig {
  Form form = Form::kWord;
  Pace pace = Pace::kSlow;
  double speed = 1.0;
  double rise = 0.0;
  std::vector<Stop> stops;
  std::vector<double> margin_m = {1, 1, 1};
  std::vector<ThingConfig> things;
};
FieldList fields(RouteConfig& config) {
  auto route = std::make_shared<OneOfTarget>();
  route->form = &config.form;
  route->word = choice_target(config.pace, {"off", "slow", "fast"});
  route->map = {
      {"speed", &config.speed, {0, 5}, "m/s", "how quick"},
      {"rise", &config.rise, {}, "", "how steep"},
  };
  route->list = list_target(config.stops);
  NumbersTarget margin{&config.margin_m, 3, 3};
  margin.one_for_all = true;
  return {
      {"route", std::move(route), {}, "", "a pace, a speed, or where to halt"},
      {"margin", margin, {0, 2}, "m", "room along each axis"},
      list_of("things", config.things, "what stands there"),
  };
}

class YamlForms : public testing::Test {
protected:
  RouteConfig loaded(std::string const& yaml, std::vector<std::string> const& overrides = {}) {
    return read_yaml<RouteConfig>(path_, yaml, overrides);
  }
  RouteConfig reloaded(RouteConfig config) { return loaded(config_yaml(fields(config))); }
  std::string error(std::string const& yaml, std::vector<std::string> const& overrides = {}) {
    return error_in(path_, [&] { (void)loaded(yaml, overrides); });
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "route.yaml";
};

TEST_F(YamlForms, AWordAMapOrAListTellTheirForm) {
  RouteConfig const word = loaded("route: fast\n");
  EXPECT_EQ(word.form, Form::kWord);
  EXPECT_EQ(word.pace, Pace::kFast);
  RouteConfig const map = loaded("route: {speed: 2, rise: 0.5}\n");
  EXPECT_EQ(map.form, Form::kMap);
  EXPECT_EQ(map.speed, 2.0);
  EXPECT_EQ(map.rise, 0.5);
  RouteConfig const list = loaded("route:\n  - {at: [1, 2]}\n  - at: [3, 4]\n");
  EXPECT_EQ(list.form, Form::kList);
  ASSERT_THAT(list.stops, SizeIs(2));
  EXPECT_THAT(list.stops[0].at_m, ElementsAre(1, 2));
  EXPECT_THAT(list.stops[1].at_m, ElementsAre(3, 4));
}

TEST_F(YamlForms, WhatIsNotWrittenKeepsItsForm) {
  RouteConfig const config = loaded("margin: 2\n");
  EXPECT_EQ(config.form, Form::kWord);
  EXPECT_EQ(config.pace, Pace::kSlow);
}

TEST_F(YamlForms, AnItemOfOneMemberMayGoWithoutItsName) {
  RouteConfig const config = loaded("route: [[1, 2], {at: [3, 4]}, [5, 6]]\n");
  ASSERT_THAT(config.stops, SizeIs(3));
  EXPECT_THAT(config.stops[0].at_m, ElementsAre(1, 2));
  EXPECT_THAT(config.stops[1].at_m, ElementsAre(3, 4));
  EXPECT_THAT(config.stops[2].at_m, ElementsAre(5, 6));
}

TEST_F(YamlForms, OneNumberMayStandForAll) {
  EXPECT_THAT(loaded("margin: 0.5\n").margin_m, ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(loaded("margin: [0.1, 0.2, 0.3]\n").margin_m, ElementsAre(0.1, 0.2, 0.3));
}

TEST_F(YamlForms, TheLastFormWins) {
  RouteConfig const config = loaded("route: [[1, 2]]\n", {"route=[[3, 4], [5, 6]]"});
  ASSERT_THAT(config.stops, SizeIs(2));
  EXPECT_THAT(config.stops[0].at_m, ElementsAre(3, 4));
  EXPECT_EQ(loaded("route: [[1, 2]]\n", {"route.speed=2"}).form, Form::kMap);
  EXPECT_EQ(loaded("route: [[1, 2]]\n", {"route=off"}).form, Form::kWord);
  EXPECT_THAT(loaded("", {"margin=2"}).margin_m, ElementsAre(2, 2, 2));
}

struct Golden {
  std::string yaml;
  std::string error;
};

class YamlFormError : public YamlForms, public testing::WithParamInterface<Golden> {};

TEST_P(YamlFormError, IsGolden) {
  EXPECT_EQ(error(GetParam().yaml), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    OneOf, YamlFormError,
    testing::Values(
        Golden{"margin: 1\nroute: quick\n",
               "FILE:2:1: route = quick: must be one of off, slow, fast"},
        Golden{"route:\n", "FILE:1:1: route: must be a single value"},
        Golden{"route:\n  speed: 6\n", "FILE:2:3: route.speed = 6: must be in [0, 5] m/s"},
        Golden{"route: {sped: 6}\n", "FILE:1:9: unknown key route.sped (did you mean speed?)"},
        Golden{"route: {speed: 1, speed: 2}\n", "FILE:1:19: duplicate key route.speed"},
        Golden{"route:\n  - at: [1, 2]\n  - at: [1, 10]\n",
               "FILE:3:5: route[1].at[1] = 10: must be in [-9, 9] m"},
        Golden{"route:\n  - att: [1, 2]\n",
               "FILE:2:5: unknown key route[0].att (did you mean at?)"}));

INSTANTIATE_TEST_SUITE_P(
    BareItems, YamlFormError,
    testing::Values(
        Golden{"route:\n  - [1, 2]\n  - [1, 10]\n",
               "FILE:3:5: route[1][1] = 10: must be in [-9, 9] m"},
        Golden{"route:\n  - [1, 2, 3]\n", "FILE:2:5: route[0]: must be a list of 2 numbers"},
        Golden{"route:\n  - [1, two]\n", "FILE:2:5: route[0][1] = two: must be a number"},
        Golden{"route:\n  - 1\n", "FILE:2:5: route[0]: must be a map of keys"},
        Golden{"things:\n  - [thing, [1]]\n", "FILE:2:5: things[0]: must be a map of keys"}));

INSTANTIATE_TEST_SUITE_P(
    OneForAll, YamlFormError,
    testing::Values(
        Golden{"margin: 3\n", "FILE:1:1: margin = 3: must be in [0, 2] m"},
        Golden{"margin: wide\n", "FILE:1:1: margin = wide: must be a number"},
        Golden{"margin: [1, 3, 1]\n", "FILE:1:1: margin[1] = 3: must be in [0, 2] m"},
        Golden{"margin: [1]\n", "FILE:1:1: margin: must be one number or a list of 3"},
        Golden{"margin: [1, 1, 1, 1]\n", "FILE:1:1: margin: must be one number or a list of 3"},
        Golden{"margin: {x: 1}\n", "FILE:1:1: margin: must be one number or a list of 3"},
        Golden{"margin:\n", "FILE:1:1: margin: must be one number or a list of 3"}));

TEST_F(YamlForms, OverridesAreToldAsTheyWereGiven) {
  EXPECT_EQ(error("", {"route=[[1, 10]]"}),
            "--set route=[[1, 10]]: route[0][1] = 10: must be in [-9, 9] m");
  EXPECT_EQ(error("", {"margin=-1"}), "--set margin=-1: margin = -1: must be in [0, 2] m");
}

TEST_F(YamlForms, ValuesThatAreRefusedChangeNothing) {
  RouteConfig config;
  write_text(path_, "margin: [0.1, 0.2]\n");
  EXPECT_NE(error_in(path_, [&] { load_config(fields(config), {path_}, {}); }), "");
  EXPECT_THAT(config.margin_m, ElementsAre(1, 1, 1));
}

TEST_F(YamlForms, PrintedFormsReadBack) {
  RouteConfig config;
  config.margin_m = {0.1, 1.0 / 3.0, 2};
  for (Pace const pace : {Pace::kOff, Pace::kSlow, Pace::kFast}) {
    config.pace = pace;
    RouteConfig const back = reloaded(config);
    EXPECT_EQ(back.form, Form::kWord);
    EXPECT_EQ(back.pace, pace);
    EXPECT_EQ(back.margin_m, config.margin_m);
  }
  config.form = Form::kMap;
  config.speed = 0.1;
  config.rise = -1.0 / 3.0;
  RouteConfig const map = reloaded(config);
  EXPECT_EQ(map.form, Form::kMap);
  EXPECT_EQ(map.speed, config.speed);
  EXPECT_EQ(map.rise, config.rise);
  config.form = Form::kList;
  EXPECT_EQ(reloaded(config).form, Form::kList);
  EXPECT_THAT(reloaded(config).stops, IsEmpty());
  config.stops = {{{1, 2}}, {{1.0 / 3.0, -9}}};
  RouteConfig const list = reloaded(config);
  EXPECT_EQ(list.form, Form::kList);
  ASSERT_THAT(list.stops, SizeIs(2));
  EXPECT_EQ(list.stops[0].at_m, config.stops[0].at_m);
  EXPECT_EQ(list.stops[1].at_m, config.stops[1].at_m);
}

TEST_F(YamlForms, OnlyTheFormInUseIsPrinted) {
  RouteConfig config;
  EXPECT_THAT(config_yaml(fields(config)),
              HasSubstr("route: slow  # a pace, a speed, or where to halt (off, slow, fast)\n"));
  config.form = Form::kMap;
  EXPECT_THAT(config_yaml(fields(config)), HasSubstr(R"(# a pace, a speed, or where to halt
route:
  speed: 1  # how quick ([0, 5] m/s)
  rise: 0  # how steep
margin: [1, 1, 1]  # room along each axis ([0, 2] m)
)"));
  config.form = Form::kList;
  config.stops = {{{1, 2}}};
  EXPECT_THAT(config_yaml(fields(config)), HasSubstr(R"(# a pace, a speed, or where to halt
route:
  -
    at: [1, 2]  # where to halt ([-9, 9] m)
)"));
}

}  // namespace
}  // namespace credo::test
