// What a recording holds reads back to the same bits; what it cannot hold is refused or counted.
#include "io/recording_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/error.hpp"
#include "io/dataset_fixture.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kStep_ns = 33'333'333;

/// Depth of counts of that unit, as sources make it.
Grid<float> depth_m_of(Grid<std::uint16_t> const& counts, double unit_m) {
  Grid<float> depth_m(counts.width(), counts.height());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    depth_m[i] = static_cast<float>(counts[i]) * static_cast<float>(unit_m);
  }
  return depth_m;
}

bool same_bits(Grid<float> const& a, Grid<float> const& b) {
  return a.same_size(b) && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class Recording : public ::testing::Test {
protected:
  static Frame frame(int n, double unit_m = 0.001) {
    Frame frame;
    frame.index = FrameIndex{3 * n};  // others were lost
    frame.stamp_ns = 1'000'000'000 + n * kStep_ns;
    frame.intrinsics = {570.1, 570.3, 15.7, 11.9};
    Grid<std::uint16_t> counts = some_depth();
    counts[1] = static_cast<std::uint16_t>(n);
    frame.cloud_camera = cloud_from_depth(depth_m_of(counts, unit_m), frame.intrinsics);
    frame.color = some_color();
    frame.color[0] = {static_cast<std::uint8_t>(n), 1, 2};
    frame.color_registered = true;
    frame.T_source_camera = Se3(Eigen::Quaterniond::Identity(), {0.1 * n, 1.0 / 3.0, -2.0});
    return frame;
  }
  std::filesystem::path out() { return folder_ / "out"; }
  std::int64_t write(std::vector<Frame> const& frames, double unit_m = 0.0) {
    RecordingWriter writer(out(), unit_m);
    for (Frame const& one : frames) {
      writer.write(one);
    }
    writer.finish();
    return writer.rounded_frames();
  }
  std::vector<FramePtr> read(std::vector<std::string>* warnings = nullptr) {
    CaptureConfig all;
    all.max_depth_m = 100.0;
    OpenedSource const opened = open_dataset(out(), all, {});
    std::vector<FramePtr> frames;
    for (SourceResult result = opened.source->next(); !std::holds_alternative<EndOfSource>(result);
         result = opened.source->next()) {
      frames.push_back(std::get<FramePtr>(result));
    }
    if (warnings != nullptr) {
      *warnings = opened.warnings;
    }
    return frames;
  }
  static void expect_same(Frame const& read, Frame const& written) {
    EXPECT_TRUE(same_bits(read.cloud_camera.z, written.cloud_camera.z));
    EXPECT_TRUE(same_bits(read.cloud_camera.x, written.cloud_camera.x));
    EXPECT_EQ(read.color, written.color);
    EXPECT_EQ(read.color_registered, written.color_registered);
    EXPECT_EQ(read.stamp_ns, written.stamp_ns);
    EXPECT_EQ(read.intrinsics, written.intrinsics);
    EXPECT_EQ(read.T_source_camera.matrix(), written.T_source_camera.matrix());
  }

  TempFolder folder_;
};

TEST_F(Recording, ReadsBackToTheSameFrames) {
  std::vector<Frame> const frames = {frame(0), frame(1), frame(2)};
  EXPECT_EQ(write(frames), 0);
  std::vector<std::string> warnings;
  std::vector<FramePtr> const read_back = read(&warnings);
  ASSERT_EQ(read_back.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_same(*read_back[i], frames[i]);
  }
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_EQ(text_of(out() / "depth.txt"),
            "1.000000000 depth/000000.png\n1.033333333 depth/000003.png\n"
            "1.066666666 depth/000006.png\n");
}

// Every count there is, of each unit that sensors and recordings have.
TEST_F(Recording, EveryCountComesBack) {
  Grid<std::uint16_t> counts(256, 256);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = static_cast<std::uint16_t>(i == 65535 ? 0 : i);
  }
  for (double const unit_m : {0.001, 0.0001, 0.0002, 0.00025}) {
    Frame all;
    all.intrinsics.cx_px = 100.0;
    all.intrinsics.cy_px = 100.0;
    all.stamp_ns = 5;
    all.cloud_camera = cloud_from_depth(depth_m_of(counts, unit_m), all.intrinsics);
    EXPECT_EQ(write({all}, unit_m == 0.00025 ? unit_m : 0.0), 0) << unit_m;
    std::vector<FramePtr> const read_back = read();
    ASSERT_EQ(read_back.size(), 1U);
    EXPECT_TRUE(same_bits(read_back[0]->cloud_camera.z, all.cloud_camera.z)) << unit_m;
    EXPECT_THAT(text_of(out() / "recording.json"), HasSubstr("depth_unit_m"));
    std::filesystem::remove_all(out());
  }
}

TEST_F(Recording, DepthThatIsNoCountIsRoundedAndCounted) {
  Frame odd = frame(1);
  odd.cloud_camera.z[7] = std::numbers::pi_v<float>;
  EXPECT_EQ(write({frame(0), odd, frame(2)}), 1);
  EXPECT_FLOAT_EQ(read()[1]->cloud_camera.z[7], 3.142F);
  std::filesystem::remove_all(out());
  Frame far = frame(1);
  far.cloud_camera.z[7] = 70.0F;
  EXPECT_EQ(write({frame(0), far}), 1);
  EXPECT_TRUE(std::isnan(read()[1]->cloud_camera.z[7]));
}

TEST_F(Recording, AFrameWithoutColourStaysOne) {
  Frame bare = frame(1);
  bare.color = {};
  Frame bare_first = frame(0);
  bare_first.color = {};
  write({bare_first, bare, frame(2)});
  std::vector<FramePtr> const read_back = read();
  ASSERT_EQ(read_back.size(), 3U);
  EXPECT_TRUE(read_back[0]->color.empty());
  EXPECT_TRUE(read_back[1]->color.empty());
  EXPECT_EQ(read_back[2]->color, frame(2).color);
}

TEST_F(Recording, UnregisteredColourStaysSo) {
  Frame beside = frame(0);
  beside.color_registered = false;
  write({beside});
  EXPECT_FALSE(read()[0]->color_registered);
  std::filesystem::remove_all(out());
  Frame later = frame(1);
  later.color_registered = false;
  write({frame(0), later});
  EXPECT_FALSE(read()[0]->color_registered);
  std::filesystem::remove_all(out());
  RecordingWriter writer(out(), 0.0);
  writer.write(frame(0));
  writer.deny_color_registered();
  writer.finish();
  EXPECT_FALSE(read()[0]->color_registered);
}

// Stamps since 1970 have more digits than a double.
TEST_F(Recording, StampsComeBackToTheNanosecond) {
  std::vector<Frame> frames = {frame(0), frame(1), frame(2)};
  for (std::size_t i = 0; i < 3; ++i) {
    frames[i].stamp_ns = 1'732'875'901'123'456'789 + static_cast<std::int64_t>(i);
  }
  write(frames);
  std::vector<FramePtr> const read_back = read();
  ASSERT_EQ(read_back.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_same(*read_back[i], frames[i]);
  }
}

TEST_F(Recording, WhatDoesNotFitIsRefused) {
  RecordingWriter writer(out(), 0.0);
  EXPECT_EQ(writer.refusal(frame(0)), std::nullopt);
  writer.write(frame(0));
  EXPECT_EQ(writer.refusal(frame(1)), std::nullopt);
  Frame other = frame(1);
  other.intrinsics.fx_px += 1;
  EXPECT_THAT(writer.refusal(other).value_or(""), HasSubstr("another size or field of view"));
  EXPECT_THROW(writer.write(other), std::logic_error);
  Frame small = frame(1);
  small.cloud_camera = cloud_from_depth(Grid<float>(8, 6, 1.0F), small.intrinsics);
  EXPECT_THAT(writer.refusal(small).value_or(""), HasSubstr("another size or field of view"));
  EXPECT_THAT(writer.refusal(frame(0)).value_or(""), HasSubstr("not after the one before"));
}

TEST_F(Recording, AFolderThatIsThereIsRefusedAndAnEmptyOneLeftNowhere) {
  { RecordingWriter(out(), 0.0).finish(); }
  EXPECT_FALSE(std::filesystem::exists(out()));
  std::filesystem::create_directories(out());
  try {
    RecordingWriter const writer(out(), 0.0);
    FAIL();
  } catch (InputError const& error) {
    EXPECT_EQ(std::string(error.what()),
              out().string() + ": is there already; name a new folder to record into");
  }
  EXPECT_THROW(RecordingWriter("/dev/null/out", 0.0), InputError);
}

TEST_F(Recording, OneThatWasCutReadsUpToTheCut) {
  {
    RecordingWriter writer(out(), 0.0);
    writer.write(frame(0));
    writer.write(frame(1));
  }
  for (char const* torn : {"depth.txt", "rgb.txt", "groundtruth.txt", "SHA256SUMS"}) {
    write_text(out() / torn, text_of(out() / torn) + "1.06");
  }
  std::vector<std::string> warnings;
  std::vector<FramePtr> const read_back = read(&warnings);
  ASSERT_EQ(read_back.size(), 2U);
  expect_same(*read_back[1], frame(1));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("was cut short")));
}

TEST_F(Recording, WhatCannotBeWrittenLeavesTheRestWhole) {
  RecordingWriter writer(out(), 0.0);
  writer.write(frame(0));
  std::filesystem::rename(out() / "rgb", out() / "gone");
  EXPECT_THROW(writer.write(frame(1)), InputError);
  std::filesystem::rename(out() / "gone", out() / "rgb");
  writer.finish();
  std::vector<FramePtr> const read_back = read();
  ASSERT_EQ(read_back.size(), 1U);
  expect_same(*read_back[0], frame(0));
}

}  // namespace
}  // namespace credo::test
