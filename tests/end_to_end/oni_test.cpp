// A Kinect's recording from end to end, whole and not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "end_to_end/contract.hpp"
#include "end_to_end/program.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class LivingRoom : public ::testing::Test {
protected:
  static fs::path recording() { return recordings() / "oni/living-room.oni"; }
  Ended run(std::string const& source) {
    return credo(
        {"run", "--source", source, "--no-dds", "--out", out().string(), "--dump", "labels"});
  }
  [[nodiscard]] fs::path out() const { return folder_ / "out"; }

  TempFolder folder_;
};

TEST_F(LivingRoom, RunsWithItsFloorAndWall) {
  CREDO_REQUIRE_RECORDING("oni/living-room.oni");
  Ended const ended = run("oni:" + recording().string());
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("12 frames in, 12 out, 0 failed, 0 dropped"));
  EXPECT_THAT(contract_faults(out()), IsEmpty());
  json const last = json::parse(read_lines(out() / "belief.jsonl").back());
  EXPECT_FALSE(last["floor"].is_null());
  EXPECT_FALSE(last["walls"].empty());
  EXPECT_FALSE(last["stuff"].empty());
}

TEST_F(LivingRoom, RunsThroughOpenniInRealTime) {
  CREDO_REQUIRE_RECORDING("oni/living-room.oni");
  Ended const ended = run("openni:" + recording().string());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(contract_faults(out()), IsEmpty());
}

TEST_F(LivingRoom, CutInHalfRunsToTheCut) {
  CREDO_REQUIRE_RECORDING("oni/living-room.oni");
  fs::copy_file(recording(), folder_ / "cut.oni");
  fs::permissions(folder_ / "cut.oni", fs::perms::owner_write, fs::perm_options::add);
  cut_file(folder_ / "cut.oni", 0.5);
  Ended const ended = run("oni:" + (folder_ / "cut.oni").string());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("cut.oni: cut short: it does not say where it ends\n"));
  EXPECT_THAT(ended.err, HasSubstr("cut.oni: holds 5 whole depth images of 12\n"));
  EXPECT_THAT(ended.out, HasSubstr("6 frames in, 5 out, 1 failed (1 lost_image), 0 dropped"));
  EXPECT_THAT(contract_faults(out()), IsEmpty());
}

TEST_F(LivingRoom, AnEmptyFileIsOneLine) {
  write_text(folder_ / "empty.oni", "");
  Ended const ended = run("oni:" + (folder_ / "empty.oni").string());
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "credo: " + (folder_ / "empty.oni").string() + ": is empty\n");
  EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace credo::test
