#include "graph/read_ahead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "graph/fakes.hpp"

namespace credo {
namespace {

std::vector<std::int64_t> rest_of(FrameSource& source) {
  std::vector<std::int64_t> indices;
  for (;;) {
    SourceResult const result = source.next();
    if (std::holds_alternative<EndOfSource>(result)) {
      return indices;
    }
    auto const* frame = std::get_if<FramePtr>(&result);
    indices.push_back(
        number(frame != nullptr ? (*frame)->index : std::get<FrameFailure>(result).index));
  }
}

TEST(ReadAhead, GivesWhatWasLookedAtAgainInItsTurn) {
  ReadAhead source(std::make_unique<test::FakeSource>(5));
  source.peek();
  EXPECT_EQ(std::get<FramePtr>(source.peek())->index, FrameIndex{1});
  EXPECT_EQ(rest_of(source), test::first(5));
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(source.next()));
}

TEST(ReadAhead, CanLookAtTheEnd) {
  ReadAhead source(std::make_unique<test::FakeSource>(1));
  source.peek();
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(source.peek()));
  EXPECT_EQ(rest_of(source), test::first(1));
}

TEST(ReadAhead, EndsAfterSoManyFramesThoseLookedAtIncluded) {
  ReadAhead source(std::make_unique<test::FakeSource>(9), 3);
  source.peek();
  EXPECT_EQ(rest_of(source), test::first(3));
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(source.next()));
}

/// Frames fail but for those named.
test::FakeSource::At good_only(std::vector<std::int64_t> const& good) {
  return [good](std::int64_t index) -> SourceResult {
    if (std::find(good.begin(), good.end(), index) == good.end()) {
      return FrameFailure{FrameIndex{index}, "noise", "unreadable"};
    }
    return test::tiny_frame(index);
  };
}

/// The number of the first good frame, -1 where there is none.
std::int64_t first_index(ReadAhead& source) {
  FramePtr const first = source.first_frame();
  return first == nullptr ? -1 : number(first->index);
}

TEST(FirstFrame, IsFoundBehindBadOnesAndNothingIsLost) {
  auto fake = std::make_unique<test::FakeSource>(6, good_only({2, 4}));
  test::FakeSource const& inner = *fake;
  ReadAhead source(std::move(fake));
  EXPECT_EQ(first_index(source), 2);
  EXPECT_EQ(inner.given(), 3) << "read no further than that";
  EXPECT_EQ(rest_of(source), test::first(6));
}

TEST(FirstFrame, IsThatOfTheFramesAlreadyLookedAt) {
  auto fake = std::make_unique<test::FakeSource>(6, good_only({1, 3}));
  test::FakeSource const& inner = *fake;
  ReadAhead source(std::move(fake));
  for (int i = 0; i < 4; ++i) {
    source.peek();
  }
  EXPECT_EQ(first_index(source), 1);
  EXPECT_EQ(first_index(source), 1);
  EXPECT_EQ(inner.given(), 4);
  EXPECT_EQ(rest_of(source), test::first(6));
}

TEST(FirstFrame, IsTheOneThatNextWillGive) {
  ReadAhead source(std::make_unique<test::FakeSource>(6, good_only({0, 3})));
  FramePtr const first = source.first_frame();
  EXPECT_EQ(std::get<FramePtr>(source.next()), first) << "the same, not a copy";
  EXPECT_EQ(first_index(source), 3);
}

TEST(FirstFrame, IsNoneWhereNoFrameIsGood) {
  ReadAhead source(std::make_unique<test::FakeSource>(4, good_only({})));
  EXPECT_EQ(first_index(source), -1);
  EXPECT_EQ(first_index(source), -1);
  EXPECT_EQ(rest_of(source), test::first(4));
  EXPECT_TRUE(std::holds_alternative<EndOfSource>(source.next()));
  ReadAhead empty(std::make_unique<test::FakeSource>(0));
  EXPECT_EQ(first_index(empty), -1);
}

TEST(FirstFrame, OfASilentSourceIsNotWaitedFor) {
  ReadAhead source(std::make_unique<test::FakeSource>(9, [](std::int64_t index) -> SourceResult {
    return FrameFailure{FrameIndex{index}, "stalled", "no frame",
                        index == 1 ? Loss::kSilence : Loss::kBad};
  }));
  EXPECT_THROW(source.first_frame(), InputError);
}

TEST(FirstFrame, IsNoneBeyondTheFramesAskedFor) {
  auto fake = std::make_unique<test::FakeSource>(9, good_only({3}));
  test::FakeSource const& inner = *fake;
  ReadAhead source(std::move(fake), 3);
  EXPECT_EQ(first_index(source), -1);
  EXPECT_EQ(inner.given(), 3);
  EXPECT_EQ(rest_of(source), test::first(3));
  ReadAhead longer(std::make_unique<test::FakeSource>(9, good_only({3})), 4);
  EXPECT_EQ(first_index(longer), 3);
}

TEST(FindLevelAhead, LosesNoFrameAndFallsBackToTheConfigWithoutAFloor) {
  auto bad_first = [](std::int64_t index) -> SourceResult {
    if (index == 0) {
      return FrameFailure{FrameIndex{0}, "noise", "unreadable"};
    }
    return test::tiny_frame(index);
  };
  PoseConfig config;
  config.level_frames = 4;
  config.camera_height_m = 1.5;
  ReadAhead source(std::make_unique<test::FakeSource>(6, bad_first));
  WorldLevel const level = find_level_ahead(source, config);
  EXPECT_FALSE(level.floor_found);
  EXPECT_DOUBLE_EQ(level.T_world_source.translation().z(), 1.5);
  EXPECT_EQ(rest_of(source), test::first(6));
}

// Each of its failures would take seconds.
TEST(FindLevelAhead, DoesNotWaitForASilentSource) {
  auto fake = std::make_unique<test::FakeSource>(9, [](std::int64_t index) -> SourceResult {
    return FrameFailure{FrameIndex{index}, "stalled", "no frame",
                        index == 3 ? Loss::kSilence : Loss::kBad};
  });
  test::FakeSource const& inner = *fake;
  ReadAhead source(std::move(fake));
  EXPECT_FALSE(find_level_ahead(source, {}).floor_found);
  EXPECT_EQ(inner.given(), 4);
  EXPECT_EQ(rest_of(source), test::first(9));
}

TEST(FindLevelAhead, ReadsNothingWhereTheSourceIsLevel) {
  auto fake = std::make_unique<test::FakeSource>(6);
  test::FakeSource const& inner = *fake;
  ReadAhead source(std::move(fake));
  PoseConfig config;
  config.level = LevelMode::kOff;
  EXPECT_TRUE(find_level_ahead(source, config).floor_found);
  EXPECT_EQ(inner.given(), 0);
}

TEST(FindLevelAhead, PutsTheFirstGoodFrameWhereTheCameraIsGiven) {
  auto fake = std::make_unique<test::FakeSource>(6, [](std::int64_t index) -> SourceResult {
    if (index < 2) {
      return FrameFailure{FrameIndex{index}, "noise", "unreadable"};
    }
    auto frame = std::make_shared<Frame>(*test::tiny_frame(index));
    frame->T_source_camera = Se3(Eigen::Quaterniond::Identity(), {0, 0, 0.1 * double(index)});
    return FramePtr(std::move(frame));
  });
  test::FakeSource const& inner = *fake;
  ReadAhead source(std::move(fake));
  PoseConfig config;
  config.level = LevelMode::kGiven;
  config.camera_x_m = 3.0;
  WorldLevel const level = find_level_ahead(source, config);
  EXPECT_TRUE(level.floor_found);
  EXPECT_TRUE(level.given);
  EXPECT_LT((level.T_world_source * Eigen::Vector3d(0, 0, 0.2) - Eigen::Vector3d(3, 0, 1)).norm(),
            1e-12);
  EXPECT_EQ(inner.given(), 3) << "reads no further";
  EXPECT_EQ(rest_of(source), test::first(6));
}

TEST(FindLevelAhead, AnEmptySourceIsNoError) {
  ReadAhead source(std::make_unique<test::FakeSource>(0));
  EXPECT_FALSE(find_level_ahead(source, PoseConfig{}).floor_found);
}

}  // namespace
}  // namespace credo
