// Damage is never silent: every file of a recording that its list names is verified.
#include "io/checksums.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "io/dataset_fixture.hpp"
#include "io/recording_writer.hpp"
#include "io/sha256.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::StartsWith;

std::string sha256_of_text(std::string const& text) {
  return sha256_of({reinterpret_cast<unsigned char const*>(text.data()), text.size()});
}

// FIPS 180-2, appendix B, and the empty text.
TEST(Sha256, IsTheStandards) {
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_text("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::string const million(1'000'000, 'a');
  std::string const sum = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
  EXPECT_EQ(sha256_of_text(million), sum);
  TempFolder const folder;
  write_text(folder / "a", million + million);  // more than one piece
  EXPECT_EQ(sha256_of_file(folder / "a"), sha256_of_text(million + million));
  EXPECT_THROW(sha256_of_file(folder / "b"), InputError);
}

/// What came of reading a folder.
struct Outcome {
  std::vector<std::int64_t> good;
  std::map<std::string, int> lost;
  std::string message;
};

class Damage : public DatasetTest {
protected:
  Damage() : recording_(folder_ / "rec") {
    RecordingWriter writer(recording_, 0.0);
    for (int n = 0; n < 4; ++n) {
      Frame frame;
      frame.index = FrameIndex{n};
      frame.stamp_ns = 40'000'000 * n;
      frame.intrinsics = {500, 500, 15.5, 11.5};
      Grid<float> depth_m(kWidth, kHeight, 1.0F + 0.001F * static_cast<float>(n));
      frame.cloud_camera = cloud_from_depth(std::move(depth_m), frame.intrinsics);
      frame.color = some_color();
      writer.write(frame);
    }
    writer.finish();
  }

  [[nodiscard]] static Outcome outcome_of(std::filesystem::path const& folder) {
    OpenedSource const opened = open_dataset(folder, {}, {});
    Outcome outcome;
    while (true) {
      SourceResult const result = opened.source->next();
      if (auto const* frame = std::get_if<FramePtr>(&result)) {
        outcome.good.push_back(number((*frame)->index));
      } else if (auto const* failure = std::get_if<FrameFailure>(&result)) {
        ++outcome.lost[failure->reason];
        outcome.message = failure->message;
      } else {
        return outcome;
      }
    }
  }
  [[nodiscard]] std::string error_at_open() const {
    try {
      static_cast<void>(open_dataset(recording_, {}, {}));
    } catch (InputError const& error) {
      return without_folder(error.what());
    }
    return "no error";
  }
  [[nodiscard]] bool sha256sum_passes() const {
    std::string const command =
        "cd '" + recording_.string() + "' && sha256sum --strict --quiet -c SHA256SUMS 2> /dev/null";
    return std::system(command.c_str()) == 0;
  }

  std::filesystem::path recording_;
};

TEST_F(Damage, NoneIsToldOfAWholeRecording) {
  Outcome const outcome = outcome_of(recording_);
  EXPECT_THAT(outcome.good, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(outcome.lost, IsEmpty());
  EXPECT_TRUE(sha256sum_passes());
  // All there is, but the list itself.
  std::size_t files = 0;
  for (auto const& entry : std::filesystem::recursive_directory_iterator(recording_)) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(Checksums(recording_ / kChecksumFile).all().size() + 1, files);
}

TEST_F(Damage, OfAnImageCostsItsFrame) {
  damage_file(recording_ / "depth/000001.png", 0.5);
  damage_file(recording_ / "rgb/000003.png", 0.9);
  EXPECT_FALSE(sha256sum_passes());
  Outcome const outcome = outcome_of(recording_);
  EXPECT_THAT(outcome.good, ElementsAre(0, 2));
  EXPECT_THAT(outcome.lost, ElementsAre(Pair("checksum", 2)));
  EXPECT_THAT(outcome.message, HasSubstr("rgb/000003.png: is damaged: it does not match"));
}

// An image that is another whole image: nothing but the checksum tells.
TEST_F(Damage, ThatDecodesIsToldAsWell) {
  std::filesystem::copy_file(recording_ / "depth/000000.png", recording_ / "depth/000002.png",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(outcome_of(recording_).good, ElementsAre(0, 1, 3));
}

TEST_F(Damage, OfTheFirstImageCostsItsFrameOnly) {
  damage_file(recording_ / "depth/000000.png", 0.5);
  Outcome const outcome = outcome_of(recording_);
  EXPECT_THAT(outcome.good, ElementsAre(1, 2, 3));
  EXPECT_THAT(outcome.lost, ElementsAre(Pair("checksum", 1)));
}

TEST_F(Damage, AMissingImageIsToldToo) {
  std::filesystem::remove(recording_ / "rgb/000002.png");
  Outcome const outcome = outcome_of(recording_);
  EXPECT_THAT(outcome.good, ElementsAre(0, 1, 3));
  EXPECT_THAT(outcome.lost, ElementsAre(Pair("checksum", 1)));
  EXPECT_THAT(outcome.message, HasSubstr("is listed in SHA256SUMS, but not there"));
}

TEST_F(Damage, OfASmallFileIsToldAtOnce) {
  for (std::string const name :
       {"depth.txt", "rgb.txt", "groundtruth.txt", "camera-intrinsics.txt", "recording.json"}) {
    std::string const whole = text_of(recording_ / name);
    for (double const share : {0.0, 0.3, 0.99}) {
      damage_file(recording_ / name, share);
      EXPECT_THAT(error_at_open(), StartsWith("/rec/" + name + ": is damaged, or was changed"));
      write_text(recording_ / name, whole);
    }
    std::filesystem::remove(recording_ / name);
    EXPECT_THAT(error_at_open(), StartsWith("/rec/" + name + ": is listed in SHA256SUMS, but not"));
    write_text(recording_ / name, whole);
  }
  EXPECT_EQ(error_at_open(), "no error");
}

TEST_F(Damage, OfTheListItself) {
  std::string const whole = text_of(recording_ / kChecksumFile);
  std::string broken = whole;
  broken[64] = 'x';
  write_text(recording_ / kChecksumFile, broken);
  EXPECT_THAT(error_at_open(), StartsWith("/rec/SHA256SUMS:1: is no line of sha256sum"));
  std::string other = whole;
  other[5] = other[5] == '0' ? '1' : '0';
  write_text(recording_ / kChecksumFile, other);
  EXPECT_THAT(outcome_of(recording_).lost, ElementsAre(Pair("checksum", 1)));
}

TEST_F(Damage, WhatIsNotListedIsNotVerified) {
  write_text(recording_ / kChecksumFile, "");
  std::filesystem::copy_file(recording_ / "depth/000000.png", recording_ / "depth/000002.png",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(outcome_of(recording_).good, ElementsAre(0, 1, 2, 3));
}

// Any dataset may have a list: `sha256sum * > SHA256SUMS`.
TEST_F(Damage, OfOtherLayouts) {
  std::filesystem::create_directories(folder_ / "plain");
  write_three();
  std::string const command =
      "cd '" + folder_.path().string() + "' && sha256sum frame-* > SHA256SUMS";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(outcome_of(folder_.path()).good, ElementsAre(0, 1, 2));
  damage_file(file(1, "pose.txt"), 0.2);
  EXPECT_THAT(outcome_of(folder_.path()).lost, ElementsAre(Pair("checksum", 1)));
  for (char const* kind : {"depth.png", "color.png", "pose.txt"}) {
    std::filesystem::remove(file(1, kind));
  }
  Outcome const outcome = outcome_of(folder_.path());
  EXPECT_THAT(outcome.good, ElementsAre(0, 2)) << "no gap in the numbers";
  EXPECT_THAT(outcome.lost, ElementsAre(Pair("checksum", 1)));
}

}  // namespace
}  // namespace credo::test
