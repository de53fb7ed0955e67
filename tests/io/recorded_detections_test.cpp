#include "io/recorded_detections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::TempFolder;
using test::write_text;

/// The text with the one place where `from` stands told as `to`.
std::string with(std::string text, std::string const& from, std::string const& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string without(std::string const& text, std::string const& part) {
  return with(text, part, "");
}

/// 36 numbers: a diagonal, and two that mirror each other.
std::string covariance(std::string const& upper = "0.5", std::string const& lower = "0.5") {
  return "[1," + upper + ",0,0,0,0, " + lower +
         ",2,0,0,0,0, 0,0,3,0,0,0, 0,0,0,4,0,0, 0,0,0,0,5,0, 0,0,0,0,0,6]";
}

std::string detection(std::string const& type = "cat") {
  return R"({"type":")" + type + R"(","position":[0.1,-0.2,1.5],)" +
         R"("orientation_xyzw":[0,0,0.6,0.8],"covariance":)" + covariance() + R"(,"score":0.9})";
}

std::string line(std::string const& frame, std::string const& detections) {
  return R"({"frame":)" + frame + R"(,"detections":[)" + detections + "]}\n";
}

std::vector<DetectionRequest> requests(std::vector<std::string> const& types) {
  std::vector<DetectionRequest> all;
  for (std::string const& type : types) {
    all.push_back({type + "_1", type, {}});
  }
  return all;
}

class RecordedDetectionsTest : public testing::Test {
protected:
  std::vector<Detection> detect(std::string const& text, std::int64_t index,
                                std::vector<std::string> const& types) {
    write_text(path_, text);
    Frame frame;
    frame.index = FrameIndex{index};
    return RecordedDetector(path_).detect(frame, requests(types));
  }

  /// The error for this text without the path, which must come first.
  std::string error_of(std::string const& text) {
    write_text(path_, text);
    try {
      RecordedDetector{path_};
    } catch (InputError const& error) {
      std::string const message = error.what();
      EXPECT_EQ(message.rfind(path_.string() + ":", 0), 0U) << message;
      return message.substr(path_.string().size() + 1);
    }
    return "no error";
  }

  /// The error for a detection that comes third in line 1, without the place.
  std::string detection_error(std::string const& wrong) {
    std::string const place = "1: detections[2]";
    std::string const message = error_of(line("0", detection() + "," + detection() + "," + wrong));
    EXPECT_EQ(message.rfind(place, 0), 0U) << message;
    return message.substr(std::min(place.size(), message.size()));
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "detections.jsonl";
};

TEST_F(RecordedDetectionsTest, ReadsADetection) {
  auto const found = detect(line("7", detection()), 7, {"cat"});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].type, "cat");
  EXPECT_EQ(found[0].score, 0.9);
  EXPECT_EQ(found[0].visible_fraction, 1.0);
  Se3 const& mean = found[0].pose_camera.mean;
  EXPECT_EQ(mean.translation(), Eigen::Vector3d(0.1, -0.2, 1.5));
  EXPECT_TRUE(mean.rotation().isApprox(Eigen::Quaterniond(0.8, 0, 0, 0.6), 1e-12));
  Matrix6d expected = Vector6d(1, 2, 3, 4, 5, 6).asDiagonal();
  expected(0, 1) = expected(1, 0) = 0.5;
  EXPECT_EQ(found[0].pose_camera.covariance, expected);
}

TEST_F(RecordedDetectionsTest, TheVisibleFractionMayBeGiven) {
  std::string const text =
      line("0", with(detection(), R"("score":0.9)", R"("score":-3,"visible_fraction":0.25)"));
  auto const found = detect(text, 0, {"cat"});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].visible_fraction, 0.25);
  EXPECT_EQ(found[0].score, -3.0);
}

TEST_F(RecordedDetectionsTest, FindsAllOfAFrameInTheOrderOfTheFile) {
  std::string const text = line("3", detection("dog")) + "\n \r\n" +
                           line("0", detection("cat") + "," + detection("ape") + "," +
                                         detection("dog") + "," + detection("cat"));
  auto const types = [&](std::int64_t index, std::vector<std::string> const& asked) {
    std::vector<std::string> found;
    for (Detection const& one : detect(text, index, asked)) {
      found.push_back(one.type);
    }
    return found;
  };
  EXPECT_THAT(types(0, {"dog", "cat"}), testing::ElementsAre("cat", "ape", "dog", "cat"))
      << "nobody asks for an ape, and the gate will tell";
  EXPECT_THAT(types(3, {"cat", "dog"}), testing::ElementsAre("dog"));
  EXPECT_THAT(types(1, {"cat", "dog"}), testing::IsEmpty());
}

TEST_F(RecordedDetectionsTest, NumbersWithoutMeasureAreRefused) {
  EXPECT_EQ(detection_error(with(detection(), "[0.1,-0.2,1.5]", "[0.1,1e5,1.5]")),
            ".position: must be within 10000 m");
  for (char const* const wrong : {"1e200", "1e-320", "1e-13"}) {
    EXPECT_EQ(detection_error(with(detection(), "0,6]", std::string("0,") + wrong + "]")),
              ".covariance: must have standard deviations in [1e-6, 1000] m and rad");
  }
  EXPECT_EQ(detect(line("0", with(detection(), "0,6]", "0,1e-12]")), 0, {"cat"}).size(), 1U);
}

TEST_F(RecordedDetectionsTest, NothingWasFoundInAnEmptyFile) {
  EXPECT_TRUE(detect("", 0, {"cat"}).empty());
  EXPECT_TRUE(detect("\n\r\n", 0, {"cat"}).empty());
  EXPECT_TRUE(detect(line("0", ""), 0, {"cat"}).empty());
}

TEST_F(RecordedDetectionsTest, AFileThatCannotBeReadSaysSo) {
  auto const error_of_path = [](std::filesystem::path const& path) -> std::string {
    try {
      RecordedDetector{path};
    } catch (InputError const& error) {
      return error.what();
    }
    return "no error";
  };
  std::string const missing = folder_ / "none.jsonl";
  EXPECT_EQ(error_of_path(missing), missing + ": recorded detections cannot be read");
  EXPECT_EQ(error_of_path(folder_.path()),
            folder_.path().string() + ": is a folder; recorded detections are a file");
}

TEST_F(RecordedDetectionsTest, BadLinesSayWhereAndWhy) {
  EXPECT_EQ(error_of("\n{\"frame\":0,\n"), "2: is not JSON from character 12 on");
  EXPECT_EQ(error_of(line("NaN", "")), "1: is not JSON from character 10 on");
  EXPECT_EQ(error_of(line("1e999", "")), "1: has a number that is too large");
  EXPECT_EQ(error_of("[]"), "1: must be an object with the keys frame, detections");
  EXPECT_EQ(error_of("{}"), "1: frame: is missing");
  EXPECT_EQ(error_of(R"({"frame":0})"), "1: detections: is missing");
  EXPECT_EQ(error_of(R"({"frame":0,"detections":{}})"), "1: detections: must be a list");
  EXPECT_EQ(error_of(R"({"frame":0,"detections":[],"Frame":0})"),
            "1: unknown key 'Frame'; the keys are frame, detections");
  std::string const whole = "1: frame: must be a whole number, 0 or above";
  EXPECT_EQ(error_of(line("-1", "")), whole);
  EXPECT_EQ(error_of(line("0.5", "")), whole);
  EXPECT_EQ(error_of(line("\"0\"", "")), whole);
  EXPECT_EQ(error_of(line("9223372036854775808", "")), whole);
  EXPECT_EQ(error_of(line("9223372036854775807", "")), "no error");
  EXPECT_EQ(error_of(line("4", "") + line("5", "") + line("4", "")),
            "3: frame: 4 has a line already");
}

TEST_F(RecordedDetectionsTest, BadKeysOfADetectionSayWhich) {
  std::string const keys = "type, position, orientation_xyzw, covariance, score, visible_fraction";
  EXPECT_EQ(detection_error("3"), ": must be an object with the keys " + keys);
  EXPECT_EQ(detection_error(with(detection(), "score", "scor")),
            ": unknown key 'scor'; the keys are " + keys);
  EXPECT_EQ(detection_error(without(detection(), R"("type":"cat",)")), ".type: is missing");
  EXPECT_EQ(detection_error(without(detection(), R"("position":[0.1,-0.2,1.5],)")),
            ".position: is missing");
  EXPECT_EQ(detection_error(without(detection(), R"("orientation_xyzw":[0,0,0.6,0.8],)")),
            ".orientation_xyzw: is missing");
  EXPECT_EQ(detection_error(without(detection(), R"("covariance":)" + covariance() + ",")),
            ".covariance: is missing");
  EXPECT_EQ(detection_error(without(detection(), R"(,"score":0.9)")), ".score: is missing");
}

TEST_F(RecordedDetectionsTest, BadValuesOfADetectionSayWhich) {
  EXPECT_EQ(detection_error(detection("")), ".type: must be a text that is not empty");
  EXPECT_EQ(detection_error(with(detection(), R"("cat")", "1")),
            ".type: must be a text that is not empty");
  EXPECT_EQ(detection_error(with(detection(), "[0.1,-0.2,1.5]", "[0,0]")),
            ".position: must be 3 numbers, has 2");
  EXPECT_EQ(detection_error(with(detection(), "[0.1,-0.2,1.5]", "0")),
            ".position: must be 3 numbers");
  EXPECT_EQ(detection_error(with(detection(), "-0.2", "null")), ".position[1]: must be a number");
  EXPECT_EQ(detection_error(with(detection(), "[0,0,0.6,0.8]", "[0,0,0,1,0]")),
            ".orientation_xyzw: must be 4 numbers, has 5");
  EXPECT_EQ(detection_error(with(detection(), "[0,0,0.6,0.8]", "[0,0,0,0.98]")),
            ".orientation_xyzw: must be of length 1, has 0.98");
  EXPECT_EQ(detection_error(with(detection(), "[0,0,0.6,0.8]", "[0,0,0,1e200]")),
            ".orientation_xyzw: must be of length 1, has inf");
  EXPECT_EQ(detection_error(with(detection(), "0.9", "\"high\"")), ".score: must be a number");
  for (std::string const fraction : {"-0.01", "1.01"}) {
    EXPECT_EQ(detection_error(with(detection(), "0.9", "0.9,\"visible_fraction\":" + fraction)),
              ".visible_fraction: must be in [0, 1]");
  }
}

TEST_F(RecordedDetectionsTest, OrientationsMayBeOffByRounding) {
  auto const found = detect(line("0", with(detection(), "0.6,0.8", "0,1.009")), 0, {"cat"});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].pose_camera.mean.rotation().norm(), 1.0);
}

TEST_F(RecordedDetectionsTest, CovariancesMustBeSymmetricAndPositiveDefinite) {
  std::string const must = ".covariance: must be symmetric and positive definite";
  auto const error_with = [&](std::string const& upper, std::string const& lower) {
    return detection_error(with(detection(), covariance(), covariance(upper, lower)));
  };
  EXPECT_EQ(error_with("0.5", "0.4999"), must);
  EXPECT_EQ(error_with("1.5", "1.5"), must);
  EXPECT_EQ(error_with("1e308", "1e308"), must);
  EXPECT_EQ(error_with("0.5", "0.5,7"), ".covariance: must be 36 numbers, has 37");
  EXPECT_EQ(error_with("0.5", "[]"), ".covariance[6]: must be a number");
  std::string const zero = with(detection(), covariance(), covariance("0", "0"));
  EXPECT_EQ(detection_error(with(zero, "0,6]", "0,0]")), must);
  EXPECT_EQ(detection_error(with(zero, "0,6]", "0,-6]")), must);
  std::string const rounded = with(detection(), covariance(), covariance("0.5", "0.5000001"));
  EXPECT_EQ(error_of(line("0", rounded)), "no error");
}

}  // namespace
}  // namespace credo
