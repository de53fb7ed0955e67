// What the real executable answers to bad usage and bad input: exit 2, one line a fault, no --out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"

namespace credo {
namespace {

using test::Ended;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct BadUsage {
  std::string name;
  std::vector<std::string> arguments;
  std::string err;
};

class BadUsages : public ::testing::TestWithParam<BadUsage> {};

TEST_P(BadUsages, AreToldInOneLineAndExitWith2) {
  Ended const ended = test::credo(GetParam().arguments);
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "credo: " + GetParam().err + "\n");
  EXPECT_EQ(ended.out, "");
}

std::vector<std::string> sim_with(std::vector<std::string> more) {
  std::vector<std::string> arguments = {"run", "--source", "sim:first-light"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, BadUsages,
    ::testing::Values(
        BadUsage{"NoCommand", {}, "A subcommand is required; see credo --help"},
        BadUsage{"UnknownCommand", {"frob"}, "frob: no such command or option; see credo --help"},
        BadUsage{"UnknownOption",
                 {"run", "--sauce", "x"},
                 "--sauce: no such command or option; see credo --help"},
        BadUsage{"NoSource", {"run"}, "--source is required; see credo --help"},
        BadUsage{"NoFrames", sim_with({"--frames", "0"}),
                 "--frames: 0: must be 1 or more; see credo --help"},
        BadUsage{"FramesNoNumber", sim_with({"--frames", "x"}),
                 "--frames: x: must be 1 or more; see credo --help"},
        BadUsage{"DumpWithoutOut", sim_with({"--dump", "labels"}),
                 "--dump has nowhere to write: add --out DIR"},
        BadUsage{"Prior", sim_with({"--prior", "/nowhere/room.yaml"}),
                 "/nowhere/room.yaml: cannot be read"},
        BadUsage{"UnknownSource",
                 {"run", "--source", "kitchen"},
                 "--source kitchen: names no source; write dataset:DIR, oni:FILE, openni: or "
                 "sim:NAME-or-FILE"},
        BadUsage{"EmptySource",
                 {"run", "--source", "dataset:"},
                 "--source dataset:: names no source; write dataset:DIR, oni:FILE, openni: or "
                 "sim:NAME-or-FILE"},
        BadUsage{"Oni", {"run", "--source", "oni:a.oni"}, "a.oni: no such recording"},
        BadUsage{"NoFolder",
                 {"run", "--source", "dataset:/nowhere"},
                 "dataset /nowhere: no such folder"},
        BadUsage{
            "NoScene",
            {"run", "--source", "sim:nowhere"},
            "sim:nowhere: no such scene or file; scenes are bottle-moves, box-on-table, "
            "cluttered-table, corridor-loop, first-light, flush-boxes, pen-on-table, room-of-200, "
            "swap-and-occlude, table-before-wall, thesis-3.4.1, "
            "thesis-3.4.2, thesis-3.4.3, thesis-3.4.4, thesis-4.4.1, thesis-4.4.2, "
            "thesis-4.4.3, thesis-4.4.4, wall-and-floor"},
        BadUsage{"PosesOfASimulation", sim_with({"--set", "pose.source=file"}),
                 "scene first-light: a simulated camera has its own poses; pose.source must not be "
                 "file"},
        BadUsage{"UnknownDump", sim_with({"--out", "/nowhere/out", "--dump", "depth"}),
                 "--dump: depth not in {labels,pictures}; see credo --help"},
        BadUsage{"OutInAFile", sim_with({"--out", "/dev/null/out"}),
                 "--out /dev/null/out: cannot be created: Not a directory"},
        BadUsage{"WhyOfNoRun", {"why"}, "run is required; see credo --help"},
        BadUsage{"PlotOfNothing",
                 {"why", "out/room", "--plot", "a.svg"},
                 "--plot requires id; see credo --help"},
        BadUsage{"PageOfAnOverlay",
                 {"config", "--markdown", "--set", "graph.threads=1"},
                 "--set excludes --markdown; see credo --help"}),
    [](auto const& instance) { return instance.param.name; });

TEST(CommandLine, HelpHasExamplesAndExitsWith0) {
  for (std::vector<std::string> const& command : {std::vector<std::string>{"--help"},
                                                  {"run", "--help"},
                                                  {"calibrate", "--help"},
                                                  {"record", "--help"},
                                                  {"doctor", "--help"},
                                                  {"why", "--help"},
                                                  {"config", "--help"}}) {
    Ended const ended = test::credo(command);
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out, HasSubstr("Examples:\n  credo "));
    EXPECT_EQ(ended.err, "");
  }
}

TEST(CommandLine, HelpNamesEveryOption) {
  std::string const run = test::credo({"run", "--help"}).out;
  for (char const* option : {"--source URI", "--config FILE", "--set KEY=VALUE", "--prior FILE",
                             "--frames N", "--out DIR", "--dump WHAT", "--no-dds", "--linger S"}) {
    EXPECT_THAT(run, HasSubstr(option));
  }
  EXPECT_THAT(test::credo({"config", "--help"}).out, HasSubstr("--markdown"));
  std::string const all = test::credo({"--help"}).out;
  EXPECT_THAT(all, HasSubstr("Exit codes: 0 done (also when stopped by Ctrl-C), 2 bad usage, "
                             "config or input, 1 anything else."));
  for (char const* command :
       {"\n  run ", "\n  record ", "\n  calibrate ", "\n  doctor ", "\n  why ", "\n  config "}) {
    EXPECT_THAT(all, HasSubstr(command));
  }
  EXPECT_THAT(test::credo({"--version"}).out, StartsWith("credo 0."));
}

TEST(CommandLine, EveryFaultOfAConfigIsToldAtOnceAndNothingIsWritten) {
  test::TempFolder const folder;
  Ended const ended =
      test::credo(sim_with({"--set", "graph.thread=2", "--set", "graph.belief_lag=0", "--out",
                            (folder / "out").string()}));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("credo: --set graph.thread=2: unknown key graph.thread (did you "
                                   "mean threads?)\n"));
  EXPECT_THAT(ended.err, HasSubstr("credo: --set graph.belief_lag=0: "));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(CommandLine, ConfigPrintsWhatItReads) {
  test::TempFolder const folder;
  Ended const first =
      test::credo({"config", "--set", "graph.edges.capture_normals.overflow=drop_oldest", "--set",
                   "graph.threads=3"});
  EXPECT_EQ(first.code, 0);
  EXPECT_THAT(first.out, HasSubstr("overflow: drop_oldest"));
  EXPECT_THAT(first.out, HasSubstr("threads: 3"));
  test::write_text(folder / "again.yaml", first.out);
  EXPECT_EQ(test::credo({"config", "--config", (folder / "again.yaml").string()}).out, first.out);
}

}  // namespace
}  // namespace credo
