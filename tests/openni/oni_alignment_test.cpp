// What a recording needs once OpenNI2's recorder has left it: true stamps, and a checksum.
#include "openni/oni_alignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "openni/oni_checksum.hpp"
#include "openni/oni_records.hpp"
#include "openni/oni_source.hpp"
#include "support/oni_writer.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 8;
constexpr int kHeight = 4;
constexpr std::uint64_t kBegan_us = 5'000'000;

Grid<std::uint16_t> depth_of(int image) {
  Grid<std::uint16_t> depth(kWidth, kHeight);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    depth[i] = static_cast<std::uint16_t>(1000 + 100 * static_cast<std::size_t>(image) + i);
  }
  return depth;
}

Grid<Rgb> color_of(int image) {
  Grid<Rgb> color(kWidth, kHeight);
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = {static_cast<std::uint8_t>(image), static_cast<std::uint8_t>(i), 9};
  }
  return color;
}

template <typename T>
Grid<T> reversed(Grid<T> image) {
  for (int v = 0; v < image.height(); ++v) {
    std::ranges::reverse(image.row(v));
  }
  return image;
}

class OniAlignment : public ::testing::Test {
protected:
  /// Both streams begin at 0, as the recorder has it.
  void record(bool mirrored) {
    OniScript script;
    script.width = kWidth;
    script.height = kHeight;
    script.mirrored = mirrored;
    for (int i = 0; i < 6; ++i) {
      Grid<std::uint16_t> const depth = mirrored ? reversed(depth_of(i)) : depth_of(i);
      Grid<Rgb> const color = mirrored ? reversed(color_of(i)) : color_of(i);
      script.depth_images.push_back(packed({depth.begin(), depth.end()}));
      script.color_images.emplace_back(reinterpret_cast<char const*>(color.data()),
                                       color.size() * sizeof(Rgb));
    }
    write_text(file(), oni_bytes(script));
    before_ = index_oni(file());
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "a.oni"; }
  /// That of a stream's image, and so long after the recording began.
  [[nodiscard]] std::uint64_t stamp_us(OniStream const& stream, int image,
                                       std::int64_t late_us) const {
    std::int64_t const since_us = stream.images[static_cast<std::size_t>(image)].stamp_ns / 1000;
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(kBegan_us) + since_us + late_us);
  }
  [[nodiscard]] FirstImages seen(std::int64_t color_late_us) const {
    FirstImages first;
    // One that came before the recording began, and then some.
    first.depth.push_back({kBegan_us - 33'333, Grid<std::uint16_t>(kWidth, kHeight, 7)});
    first.depth.push_back({stamp_us(before_.depth, 1, 0), depth_of(1)});
    first.color.push_back({stamp_us(*before_.color, 2, color_late_us), color_of(2)});
    return first;
  }

  TempFolder folder_;
  OniIndex before_;
};

TEST_F(OniAlignment, ColourThatBeganLaterIsLater) {
  for (bool const mirrored : {false, true}) {
    record(mirrored);
    EXPECT_EQ(align_oni(file(), seen(33'333)), 33'333);
    OniIndex const after = index_oni(file());
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(after.depth.images[i].stamp_ns, before_.depth.images[i].stamp_ns);
      EXPECT_EQ(after.color->images[i].stamp_ns, before_.color->images[i].stamp_ns + 33'333'000);
    }
    // Which pairs each depth with the colour of its moment.
    OpenedSource const opened = open_oni(file(), {}, {});
    auto const first = std::get<FramePtr>(opened.source->next());
    auto const second = std::get<FramePtr>(opened.source->next());
    EXPECT_TRUE(first->color.empty());
    EXPECT_EQ(second->color, color_of(0));
  }
}

TEST_F(OniAlignment, DepthThatBeganLaterIsLater) {
  record(false);
  EXPECT_EQ(align_oni(file(), seen(-20'000)), -20'000);
  OniIndex const after = index_oni(file());
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(after.depth.images[i].stamp_ns, before_.depth.images[i].stamp_ns + 20'000'000);
    EXPECT_EQ(after.color->images[i].stamp_ns, before_.color->images[i].stamp_ns);
  }
}

TEST_F(OniAlignment, WhatIsRightOrUnknownStays) {
  record(false);
  std::string const bytes = text_of(file());
  EXPECT_EQ(align_oni(file(), seen(0)), 0);
  FirstImages strange = seen(5);
  strange.color[0].image[0] = {200, 200, 200};
  EXPECT_EQ(align_oni(file(), strange), std::nullopt);
  EXPECT_EQ(align_oni(file(), {}), std::nullopt);
  EXPECT_EQ(text_of(file()), bytes);
}

TEST_F(OniAlignment, AnIndexKnowsWhereTheRecordingEnds) {
  record(false);
  auto const size = std::filesystem::file_size(file());
  EXPECT_EQ(before_.end_bytes, size);
  std::filesystem::resize_file(file(), 2 * size);  // a hole
  EXPECT_EQ(index_oni(file()).end_bytes, size);
  std::filesystem::resize_file(file(), size - 28);  // without its end
  EXPECT_EQ(index_oni(file()).end_bytes, 0U);
}

TEST_F(OniAlignment, AChecksumTellsOfAnyDamage) {
  record(false);
  EXPECT_NO_THROW(check_oni_checksum(file())) << "there is none";
  write_oni_checksum(file());
  EXPECT_NO_THROW(check_oni_checksum(file()));
  for (double const share : {0.0, 0.2, 0.5, 0.999}) {
    damage_file(file(), share);
    try {
      open_oni(file(), {}, {});
      ADD_FAILURE() << share;
    } catch (InputError const& error) {
      EXPECT_THAT(error.what(), HasSubstr("a.oni: is damaged, or was changed"));
    }
    damage_file(file(), share);  // turns it back
  }
  EXPECT_NO_THROW(open_oni(file(), {}, {}));
}

}  // namespace
}  // namespace credo::test
