// Things in a real kitchen keep their names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iostream>
#include <numeric>
#include <optional>
#include <vector>

#include "end_to_end/followed_places.hpp"
#include "end_to_end/recording_views.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

constexpr std::int64_t kFrames = 500;

/// The recording as it is, or as it might have been taken.
struct Variant {
  char const* name;
  /// Every so many frames; negative from the last to the first.
  std::int64_t step = 1;
  /// Depth of a rectangle that wanders over the image.
  std::optional<float> rectangle_m = std::nullopt;
  /// What was measured, and a little more: the figures are in docs/belief.md.
  double most_switches_per_1000 = 0.0;
  std::size_t most_ids = 0;
};

class Kitchen : public testing::TestWithParam<Variant> {
protected:
  [[nodiscard]] std::unique_ptr<FrameSource> source() const {
    Variant const& variant = GetParam();
    std::vector<std::int64_t> numbers;
    for (std::int64_t frame = 0; frame < kFrames; frame += std::abs(variant.step)) {
      numbers.push_back(frame);
    }
    if (variant.step < 0) {
      std::ranges::reverse(numbers);
    }
    std::unique_ptr<FrameSource> frames =
        frames_of(recordings() / "kitchen", numbers, folder_.path());
    if (!variant.rectangle_m) {
      return frames;
    }
    return painted(std::move(frames), [&variant](Grid<float>& depth_m, std::int64_t frame) {
      paint_rectangle(depth_m, frame, *variant.rectangle_m);
    });
  }

  TempFolder folder_;
};

TEST_P(Kitchen, ThingsKeepTheirNames) {
  CREDO_REQUIRE_RECORDING("kitchen");
  std::vector<FollowedPlace> const places = follow(
      source(), {},
      places_of(recordings() / "kitchen",
                read_marked_places(source_folder() / "tests/end_to_end/kitchen_places.txt")));
  std::cout << report_of(places);
  ASSERT_EQ(places.size(), 6U);
  EXPECT_LE(switches_per_1000(places), GetParam().most_switches_per_1000);
  for (FollowedPlace const& place : places) {
    EXPECT_GT(place.shown, 5) << place.thing;
    EXPECT_LE(place.frames_of_id.size(), GetParam().most_ids) << place.thing;
    EXPECT_LE(place.lost, 2 + place.shown / 4) << place.thing;
  }
}

TEST(KitchenMagazines, AreNotTheTable) {
  CREDO_REQUIRE_RECORDING("kitchen");
  TempFolder const folder;
  std::vector<std::int64_t> numbers(kFrames);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::vector<FollowedPlace> const places = follow(
      frames_of(recordings() / "kitchen", numbers, folder.path()), {},
      places_of(recordings() / "kitchen",
                read_marked_places(source_folder() / "tests/end_to_end/kitchen_magazines.txt")));
  std::cout << report_of(places);
  ASSERT_EQ(places.size(), 3U);
  // A few millimetres high, two metres away: what was measured, and a little less.
  std::vector<std::uint32_t> ids;
  for (FollowedPlace const& place : places) {
    auto const [id, frames] = *std::ranges::max_element(
        place.frames_of_id, {}, [](auto const& of_id) { return of_id.second; });
    EXPECT_GT(place.shown, 100) << place.thing;
    EXPECT_GE(frames, place.shown * 9 / 10) << place.thing;
    ids.push_back(id);
  }
  std::ranges::sort(ids);
  EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
}

INSTANTIATE_TEST_SUITE_P(Recording, Kitchen,
                         testing::Values(Variant{"AsItIs", 1, std::nullopt, 10.0, 2},
                                         Variant{"EveryThirdFrame", 3, std::nullopt, 10.0, 2},
                                         Variant{"Backward", -2, std::nullopt, 10.0, 2},
                                         Variant{"BehindARectangle", 2, 0.6F, 10.0, 2},
                                         Variant{"WithoutDepthInARectangle", 2, 0.0F, 10.0, 2},
                                         Variant{"EachFrameBehindARectangle", 1, 0.6F, 10.0, 2},
                                         Variant{"EachFrameWithoutDepthInARectangle", 1, 0.0F, 10.0,
                                                 2}),
                         [](auto const& instance) { return instance.param.name; });

}  // namespace
}  // namespace credo::test
