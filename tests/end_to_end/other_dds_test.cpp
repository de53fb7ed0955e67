// A DDS of another make, with types made of the same IDL, reads what Credo writes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "support/paths.hpp"

namespace credo::test {
namespace {

// With known objects, walls, a floor and stuff: all fields of all of them, to the bit.
TEST(OtherDds, FastDdsReadsTheBeliefAsItIsInTheFile) {
  TempFolder const folder;
  std::string const prefix = "other_" + std::to_string(getpid());
  Program run(credo_command({"run", "--source", "sim:box-on-table", "--prior",
                             (source_folder() / "scenes/priors/box-on-table.yaml").string(),
                             "--set", "detector.kind=sim", "--set", "dds.topic_prefix=" + prefix,
                             "--out", (folder / "out").string(), "--linger", "60"}));
  for (int i = 0; i < 600 && read_text(folder / "out/metrics.json").empty(); ++i) {
    usleep(50000);
  }
  Ended const read = Program({CREDO_FASTDDS_READER, prefix + "/belief", "20"}).wait();
  EXPECT_EQ(read.code, 0) << read.err;
  std::vector<std::string> const lines = read_lines(folder / "out/belief.jsonl");
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(read.out, lines.back() + "\n");
  run.send(SIGINT);
  EXPECT_EQ(run.wait().code, 0);
}

}  // namespace
}  // namespace credo::test
