// The check of the file formats finds what is broken.
#include "end_to_end/contract.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"
#include "io/image.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

class ContractTest : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    run_ = new test::TempFolder;
    test::credo({"run", "--source", "sim:first-light", "--frames", "3", "--out",
                 run_->path().string(), "--dump", "labels"});
  }
  static void TearDownTestSuite() { delete run_; }

  /// Replaces the first `from` in a file of the run; it must be there.
  static std::vector<std::string> faults_with(std::string const& file, std::string const& from,
                                              std::string const& to) {
    std::string const whole = test::read_text(*run_ / file);
    std::string text = whole;
    std::size_t const at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) {
      text.replace(at, from.size(), to);
    }
    test::write_text(*run_ / file, text);
    std::vector<std::string> faults = test::contract_faults(run_->path());
    test::write_text(*run_ / file, whole);
    return faults;
  }

  static test::TempFolder* run_;
};

test::TempFolder* ContractTest::run_ = nullptr;

TEST_F(ContractTest, ARunKeepsIt) {
  EXPECT_THAT(test::contract_faults(run_->path()), IsEmpty());
}

TEST_F(ContractTest, BrokenLinesAreFound) {
  EXPECT_THAT(faults_with("belief.jsonl", R"("schema":1)", R"("schema":2)"),
              ElementsAre("frame 0: schema"));
  EXPECT_THAT(faults_with("belief.jsonl", R"("frame":1)", R"("frame":0)"), Not(IsEmpty()));
  EXPECT_THAT(faults_with("belief.jsonl", R"("segmented_with":-1)", R"("segmented_with":7)"),
              ElementsAre("frame 0: segmented_with"));
  EXPECT_THAT(faults_with("belief.jsonl", R"("evidence":"seen")", R"("evidence":"perhaps")"),
              Not(IsEmpty()));
  EXPECT_THAT(faults_with("belief.jsonl", R"("label":4000)", R"("label":3999)"), Not(IsEmpty()));
  EXPECT_THAT(faults_with("belief.jsonl", R"("label":4000)", R"("label":64000)"), Not(IsEmpty()));
  EXPECT_THAT(faults_with("belief.jsonl", R"("history")", R"("hystory")"), Not(IsEmpty()));
}

TEST_F(ContractTest, BrokenMetricsAreFound) {
  EXPECT_THAT(faults_with("metrics.json", R"("frames_out": 3)", R"("frames_out": 2)"),
              ElementsAre("metrics.json: in = out + failed + dropped",
                          "metrics.json: a line for each frame out"));
  EXPECT_THAT(faults_with("metrics.json", R"("peak": )", R"("peak": 9)"), Not(IsEmpty()));
  EXPECT_THAT(faults_with("metrics.json", R"("fps")", R"("spf")"), Not(IsEmpty()));
}

TEST_F(ContractTest, MissingFilesAreFound) {
  EXPECT_THAT(test::contract_faults(*run_ / "nowhere"), Not(IsEmpty()));
  fs::rename(*run_ / "labels/000001.png", *run_ / "kept.png");
  EXPECT_THAT(test::contract_faults(run_->path()), Not(IsEmpty()));
  fs::rename(*run_ / "kept.png", *run_ / "labels/000001.png");
}

}  // namespace
}  // namespace credo
