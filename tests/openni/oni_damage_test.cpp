// Recordings that are empty, cut short or damaged: what is whole is read, what is not is counted,
// and nothing is passed over in silence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "openni/oni_records.hpp"
#include "openni/oni_source.hpp"
#include "support/oni_writer.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kFrames = 6;
constexpr std::size_t kDepthBytes = 2 * 8 * 4;

/// What became of the frames of a recording.
struct Outcome {
  std::vector<std::int64_t> good;
  std::map<std::string, int> lost;
  std::vector<std::string> warnings;
};

class OniDamage : public ::testing::Test {
protected:
  OniDamage() {
    OniScript script;
    script.width = 8;
    script.height = 4;
    for (int i = 0; i < kFrames; ++i) {
      // No byte of it looks like a record.
      script.depth_images.push_back(packed(std::vector<std::uint16_t>(32, 1000)));
      script.color_images.emplace_back(32 * 3, 'c');
    }
    bytes_ = oni_bytes(script);
  }

  Outcome outcome(std::string const& bytes) {
    write_text(folder_ / "a.oni", bytes);
    OpenedSource const opened = open_oni(folder_ / "a.oni", {}, {});
    Outcome outcome{{}, {}, opened.warnings};
    std::int64_t frames = 0;
    for (;; ++frames) {
      SourceResult const result = opened.source->next();
      if (auto const* frame = std::get_if<FramePtr>(&result)) {
        outcome.good.push_back(number((*frame)->index));
      } else if (auto const* failure = std::get_if<FrameFailure>(&result)) {
        EXPECT_EQ(number(failure->index), frames);
        ++outcome.lost[failure->reason];
      } else {
        break;
      }
    }
    EXPECT_EQ(static_cast<std::size_t>(frames), opened.frame_count.value());
    return outcome;
  }

  std::string error(std::string const& bytes) {
    write_text(folder_ / "a.oni", bytes);
    try {
      open_oni(folder_ / "a.oni", {}, {});
    } catch (InputError const& error) {
      return error.what();
    }
    return "";
  }

  /// Where the n-th depth image lies.
  [[nodiscard]] std::size_t depth_image(int n) const {
    std::string const image = packed(std::vector<std::uint16_t>(32, 1000));
    std::size_t at = bytes_.find(image);
    for (int i = 0; i < n; ++i) {
      at = bytes_.find(image, at + kDepthBytes);
    }
    return at;
  }

  TempFolder folder_;
  std::string bytes_;
};

TEST_F(OniDamage, WholeIsWhole) {
  Outcome const result = outcome(bytes_);
  EXPECT_THAT(result.good, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(result.warnings, IsEmpty());
  // OpenNI2's recorder may leave more behind the end.
  EXPECT_THAT(outcome(bytes_ + std::string(1000, 'x')).warnings, IsEmpty());
}

TEST_F(OniDamage, WhatIsNoRecordingIsOneLine) {
  std::string const file = (folder_ / "a.oni").string();
  EXPECT_EQ(error(""), file + ": is empty");
  EXPECT_EQ(error("hello"), file + ": is no ONI recording: it does not begin with NI10");
  EXPECT_EQ(error("NI10"),
            file + ": has no depth (" + file + ": cut short: it does not say where it ends)");
  EXPECT_THAT(error(bytes_.substr(0, 200)), HasSubstr(": has no depth (" + file + ": cut short"));
  EXPECT_THROW(open_oni(folder_ / "nowhere.oni", {}, {}), InputError);
  EXPECT_THROW(open_oni(folder_.path(), {}, {}), InputError);
  mkfifo((folder_ / "pipe.oni").c_str(), 0600);
  EXPECT_THROW(open_oni(folder_ / "pipe.oni", {}, {}), InputError);
}

// At every byte: never a crash, never a frame too many, and it is always told.
TEST_F(OniDamage, CutAnywhereKeepsWhatComesBefore) {
  for (std::size_t size = depth_image(0) + kDepthBytes; size < bytes_.size(); ++size) {
    Outcome const result = outcome(bytes_.substr(0, size));
    std::vector<std::int64_t> expected;
    for (int i = 0; i < kFrames && depth_image(i) + kDepthBytes <= size; ++i) {
      expected.push_back(i);
    }
    ASSERT_EQ(result.good, expected) << size;
    ASSERT_THAT(result.warnings.at(0), HasSubstr("cut short: it does not say where it ends"));
    if (expected.size() < kFrames) {
      std::string const whole =
          "holds " + std::to_string(expected.size()) + " whole depth images of 6";
      ASSERT_THAT(result.warnings, ::testing::Contains(HasSubstr(whole)));
    }
  }
}

TEST_F(OniDamage, ADamagedRecordIsPassedOverAndCounted) {
  std::string damaged = bytes_;
  damaged.replace(depth_image(2) - 40, 4, "....");  // the magic of its record
  Outcome const result = outcome(damaged);
  EXPECT_THAT(result.good, ElementsAre(0, 1, 3, 4, 5));
  EXPECT_THAT(result.lost, ElementsAre(std::pair<std::string const, int>("lost_image", 1)));
  EXPECT_THAT(result.warnings,
              ElementsAre(HasSubstr(": damaged at byte " + std::to_string(depth_image(2) - 40)),
                          HasSubstr("holds 5 whole depth images of 6")));
}

TEST_F(OniDamage, ALongGapLosesWhatLayInIt) {
  std::string damaged = bytes_;
  std::size_t const from = depth_image(1) - 10;
  damaged.replace(from, depth_image(4) - from - 45, depth_image(4) - from - 45, '?');
  Outcome const result = outcome(damaged);
  EXPECT_THAT(result.good, ElementsAre(0, 4, 5));
  EXPECT_EQ(result.lost.at("lost_image"), 3);
}

// A size that reaches beyond the file is no cut where whole records follow.
TEST_F(OniDamage, ADamagedSizeLosesItsImageOnly) {
  std::size_t const record = depth_image(2) - 40;
  for (int bit = 0; bit < 32; ++bit) {
    std::string damaged = bytes_;
    damaged[record + 16 + static_cast<std::size_t>(bit / 8)] ^= static_cast<char>(1 << (bit % 8));
    Outcome const result = outcome(damaged);
    EXPECT_THAT(result.good, ElementsAre(0, 1, 3, 4, 5)) << "bit " << bit;
    EXPECT_FALSE(result.warnings.empty()) << "bit " << bit;
  }
}

TEST_F(OniDamage, ATypeThatBecomesAnEndIsNone) {
  std::string damaged = bytes_;
  damaged[depth_image(2) - 40 + 4] = 0x0B;
  Outcome const result = outcome(damaged);
  EXPECT_THAT(result.good, ElementsAre(0, 1, 3, 4, 5));
  EXPECT_EQ(result.lost.at("lost_image"), 1);
}

TEST_F(OniDamage, ANumberThatIsNoneInventsNoFrames) {
  std::string damaged = bytes_;
  damaged.replace(depth_image(3) - 4, 4, "\xFF\xFF\xFF\x7F");
  EXPECT_THAT(outcome(damaged).good, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST_F(OniDamage, PackedDepthThatDoesNotComeOutIsLost) {
  OniScript script;
  script.width = 4;
  script.height = 1;
  script.depth_codec = "16zP";
  // Four values, five, two.
  script.depth_images = {"\xE8\x03\x66\x6D", "\xE8\x03\x66\x66", "\xE8\x03\x6D"};
  Outcome const result = outcome(oni_bytes(script));
  EXPECT_THAT(result.good, ElementsAre(0));
  EXPECT_EQ(result.lost.at("unreadable_image"), 2);
}

TEST_F(OniDamage, ColourThatIsNoImageCostsItsFrame) {
  OniScript script;
  script.width = 8;
  script.height = 4;
  script.color_codec = "JPEG";
  script.depth_images = {packed(std::vector<std::uint16_t>(32, 1000))};
  script.color_images = {"no picture"};
  EXPECT_EQ(outcome(oni_bytes(script)).lost.at("unreadable_image"), 1);
}

}  // namespace
}  // namespace credo::test
