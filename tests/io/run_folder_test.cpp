#include "io/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string text_of(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

EncodedPng small_labels() {
  return encode_png16(Grid<std::uint16_t>(2, 1, {1000, 65535}));
}

TEST(RunFolder, HoldsTheFilesOfARun) {
  TempFolder const temp;
  fs::path const out = temp / "deep/er";
  RunFolder folder(out, true, true, "gain: 1\n");
  folder.write_labels(FrameIndex{7}, small_labels());
  folder.write_picture(FrameIndex{1234567}, encode_png_rgb(Grid<Rgb>(1, 1, {1, 2, 3})));
  folder.write_belief("{\"frame\":7}");
  // Readable while the run goes on: a kill loses no line.
  EXPECT_EQ(text_of(out / "belief.jsonl"), "{\"frame\":7}\n");
  folder.write_belief("{\"frame\":8}");
  folder.write_metrics(RunMetrics());

  EXPECT_EQ(text_of(out / "belief.jsonl"), "{\"frame\":7}\n{\"frame\":8}\n");
  EXPECT_EQ(text_of(out / "config.yaml"), "gain: 1\n");
  EXPECT_EQ(text_of(out / "metrics.json"), metrics_json(RunMetrics()));
  EXPECT_FALSE(fs::exists(out / "metrics.json.part"));
  EXPECT_EQ(read_png16(out / "labels/000007.png"), (Grid<std::uint16_t>(2, 1, {1000, 65535})));
  EXPECT_EQ(read_color(out / "pictures/1234567.png"), Grid<Rgb>(1, 1, {1, 2, 3}));
}

TEST(RunFolder, MakesOnlyTheFoldersThatAreAskedFor) {
  TempFolder const temp;
  RunFolder const folder(temp / "out", false, false, "");
  EXPECT_FALSE(fs::exists(temp / "out/labels"));
  EXPECT_FALSE(fs::exists(temp / "out/pictures"));
}

TEST(RunFolder, ReplacesAnEarlierRunAndNothingElse) {
  TempFolder const temp;
  {
    RunFolder earlier(temp.path(), true, true, "old");
    earlier.write_belief("old");
    earlier.write_labels(FrameIndex{5}, small_labels());
    earlier.write_picture(FrameIndex{5}, small_labels());
    earlier.write_metrics(RunMetrics());
  }
  write_text(temp / "notes.txt", "mine");
  write_text(temp / "labels/mask.png", "mine");
  write_text(temp / "labels/12.png", "mine");
  RunFolder const folder(temp.path(), true, false, "new");
  EXPECT_EQ(text_of(temp / "belief.jsonl"), "");
  EXPECT_EQ(text_of(temp / "config.yaml"), "new");
  EXPECT_FALSE(fs::exists(temp / "metrics.json")) << "would be taken for this run's";
  EXPECT_FALSE(fs::exists(temp / "labels/000005.png"));
  EXPECT_FALSE(fs::exists(temp / "pictures"));
  EXPECT_EQ(text_of(temp / "notes.txt"), "mine");
  EXPECT_EQ(text_of(temp / "labels/mask.png"), "mine");
  EXPECT_EQ(text_of(temp / "labels/12.png"), "mine");
}

TEST(RunFolder, RefusesAPathThatAFileBlocks) {
  TempFolder const temp;
  write_text(temp / "file", "");
  for (char const* out : {"file", "file/below"}) {
    EXPECT_THAT([&] { RunFolder(temp / out, false, false, ""); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr("--out"), HasSubstr(out), HasSubstr("cannot be created"))));
  }
  fs::create_directories(temp / "run");
  write_text(temp / "run/labels", "");
  EXPECT_THAT([&] { RunFolder(temp / "run", true, false, ""); },
              ThrowsMessage<InputError>(HasSubstr("run/labels")));
}

TEST(RunFolder, RefusesWhereItsFilesCannotBeWritten) {
  TempFolder const temp;
  fs::create_directories(temp / "belief.jsonl/folder");
  EXPECT_THAT([&] { RunFolder(temp.path(), false, false, ""); },
              ThrowsMessage<InputError>(HasSubstr("belief.jsonl: cannot be written")));
}

TEST(RunFolder, AFullDiskIsAnErrorThatNamesTheFile) {
  if (!fs::exists("/dev/full")) {
    GTEST_SKIP() << "no /dev/full here";
  }
  TempFolder const temp;
  fs::create_symlink("/dev/full", temp / "belief.jsonl");
  fs::create_symlink("/dev/full", temp / "metrics.json.part");
  RunFolder folder(temp.path(), true, false, "");
  EXPECT_THAT([&] { folder.write_belief("{}"); },
              ThrowsMessage<InputError>(HasSubstr("belief.jsonl: cannot be written")));
  EXPECT_THAT([&] { folder.write_metrics(RunMetrics()); },
              ThrowsMessage<InputError>(HasSubstr("metrics.json.part: cannot be written")));
  EXPECT_FALSE(fs::exists(temp / "metrics.json"));
  fs::create_symlink("/dev/full", temp / "labels/000001.png");
  EXPECT_THAT([&] { folder.write_labels(FrameIndex{1}, small_labels()); },
              ThrowsMessage<InputError>(HasSubstr("000001.png")));
}

TEST(MetricsJson, IsTheFormatOfTheFile) {
  RunMetrics metrics;
  metrics.frames_in = 10;
  metrics.frames_out = 7;
  metrics.failed = 1;
  metrics.failures = {{"truncated_image", 1}};
  metrics.dropped = {{"capture_full", 2}};
  metrics.wall_s = 0.5;
  metrics.cpu_s = 1.5;
  metrics.fps = 14.0;
  metrics.peak_rss_mb = 300.0;
  metrics.rss_mb_at_100 = 200.0;
  metrics.rss_mb_end = 250.0;
  metrics.latency = {7, 1.0, 2.0, 3.0, 4.0};
  metrics.stages = {{"normals", {7, 5.0, 6.0, 7.0, 8.0}}, {"fusion", {7, 0, 0, 0, 0}}};
  metrics.queues = {{"capture", {4, 3, 2}}};
  auto const json = nlohmann::ordered_json::parse(metrics_json(metrics));
  EXPECT_EQ(
      json.dump(),
      R"({"frames_in":10,"frames_out":7,"failed":1,"failures":{"truncated_image":1},)"
      R"("dropped":{"capture_full":2},"wall_s":0.5,"cpu_s":1.5,"fps":14.0,)"
      R"("peak_rss_mb":300.0,"rss_mb_at_100":200.0,"rss_mb_end":250.0,)"
      R"("latency_ms":{"p50":1.0,"p95":2.0,"p99":3.0,"max":4.0},)"
      R"("stages":{"normals":{"count":7,"p50_ms":5.0,"p95_ms":6.0,"p99_ms":7.0,"max_ms":8.0},)"
      R"("fusion":{"count":7,"p50_ms":0.0,"p95_ms":0.0,"p99_ms":0.0,"max_ms":0.0}},)"
      R"("queues":{"capture":{"capacity":4,"peak":3,"dropped":2}}})");
}

TEST(MetricsJson, OfNothingHasEmptyMapsNotNulls) {
  auto const json = nlohmann::ordered_json::parse(metrics_json(RunMetrics()));
  for (char const* key : {"failures", "dropped", "stages", "queues"}) {
    EXPECT_EQ(json[key].dump(), "{}") << key;
  }
}

}  // namespace
}  // namespace credo::test
