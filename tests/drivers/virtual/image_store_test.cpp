#include "drivers/virtual/image_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "drivers/virtual/plain_dataset.hpp"

namespace credo::test {
namespace {

/// More than 1 MB: an image has 15 360 bytes.
constexpr std::size_t kMany = 100;
constexpr std::size_t kFitting = (1U << 20U) / 15360;

class ImageStore : public ::testing::Test {
protected:
  void SetUp() override { write_dataset(folder_.path(), kMany); }

  static credo::ImageStore::Order loop(std::size_t count) {
    return [count](std::int64_t position) {
      return std::optional(static_cast<std::size_t>(position) % count);
    };
  }
  static void silent(std::string const& what) { ADD_FAILURE() << what; }

  TempFolder folder_;
};

TEST_F(ImageStore, ADatasetThatFitsIsDecodedOnce) {
  SensorDataset const dataset(folder_.path());
  credo::ImageStore store(dataset, 2, loop(kMany), silent);
  store.wait_until_ahead();
  EXPECT_EQ(store.held(), kMany);
  std::filesystem::remove_all(folder_.path());
  for (std::int64_t position = 0; position < 250; ++position) {
    SensorImagesPtr const images = store.at(position, {});
    ASSERT_NE(images, nullptr) << position;
    EXPECT_EQ(images->depth_mm, depth_of(static_cast<std::size_t>(position) % kMany)) << position;
  }
}

TEST_F(ImageStore, OneThatDoesNotFitIsDecodedAhead) {
  SensorDataset const dataset(folder_.path());
  credo::ImageStore store(dataset, 1, loop(kMany), silent);
  store.wait_until_ahead();
  EXPECT_EQ(store.held(), kFitting - 3);
  for (std::int64_t position = 0; position < 250; ++position) {
    SensorImagesPtr const images = store.at(position, {});
    ASSERT_NE(images, nullptr) << position;
    EXPECT_EQ(images->color, color_of(static_cast<std::size_t>(position) % kMany)) << position;
    EXPECT_LE(store.held(), kFitting);
    if (position > 2) {
      // The other stream is a little behind.
      EXPECT_NE(store.at(position - 2, {}), nullptr) << position;
    }
  }
}

// After a pause, such as an unplugged sensor's.
TEST_F(ImageStore, GoesOnAfterALeap) {
  SensorDataset const dataset(folder_.path());
  credo::ImageStore store(dataset, 1, loop(kMany), silent);
  SensorImagesPtr const images = store.at(5090, {});
  ASSERT_NE(images, nullptr);
  EXPECT_EQ(images->color, color_of(90));
  store.wait_until_ahead();
  EXPECT_LE(store.held(), kFitting);
  EXPECT_EQ(store.at(5070, {}), nullptr) << "far behind, it is not decoded again";
}

TEST_F(ImageStore, WhatCannotBeReadIsToldAndIsNoImage) {
  cut_file(image_file(folder_.path(), 2, "color"), 0.5);
  SensorDataset const dataset(folder_.path());
  std::atomic<int> told = 0;
  credo::ImageStore store(dataset, 64, loop(kMany), [&](std::string const& what) {
    EXPECT_THAT(what, testing::HasSubstr("0002.color.png"));
    ++told;
  });
  EXPECT_NE(store.at(1, {}), nullptr);
  EXPECT_EQ(store.at(2, {}), nullptr);
  EXPECT_NE(store.at(3, {}), nullptr);
  EXPECT_EQ(store.at(2 + kMany, {}), nullptr);
  EXPECT_EQ(told, 1);
}

TEST_F(ImageStore, EndsWhereTheOrderEnds) {
  SensorDataset const dataset(folder_.path());
  credo::ImageStore store(
      dataset, 1,
      [](std::int64_t position) {
        return position < 3 ? std::optional(static_cast<std::size_t>(position)) : std::nullopt;
      },
      silent);
  store.wait_until_ahead();
  EXPECT_EQ(store.held(), 3U);
  EXPECT_NE(store.at(2, {}), nullptr);
  EXPECT_EQ(store.at(3, {}), nullptr);
}

}  // namespace
}  // namespace credo::test
