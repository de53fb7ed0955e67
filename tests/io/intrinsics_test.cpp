#include "io/intrinsics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::TempFolder;
using test::write_text;

class IntrinsicsTest : public testing::Test {
protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "camera-intrinsics.txt"; }

  /// Those found for an image of 640x480 pixels.
  CameraIntrinsics found(CaptureConfig const& config = {}) {
    return find_intrinsics(folder_.path(), config, 640, 480, warnings_);
  }
  /// The error for a file with this text, without the path; the path must come first.
  std::string error_of(std::string const& text) {
    write_text(file(), text);
    return error_of(CaptureConfig{}, file().string() + ": ");
  }
  std::string error_of(CaptureConfig const& config, std::string const& start) {
    try {
      found(config);
    } catch (InputError const& error) {
      std::string const message = error.what();
      EXPECT_EQ(message.rfind(start, 0), 0U) << message;
      return message.substr(start.size());
    }
    return "no error";
  }

  TempFolder folder_;
  std::vector<std::string> warnings_;
};

CaptureConfig given(double fx, double fy, double cx, double cy) {
  CaptureConfig config;
  config.camera_fx_px = fx;
  config.camera_fy_px = fy;
  config.camera_cx_px = cx;
  config.camera_cy_px = cy;
  return config;
}

TEST_F(IntrinsicsTest, ReadsTheMatrixRowByRow) {
  write_text(file(), "585.5\t 0.0 320\n0 586 240.25 \n0.0 0.0 1.0\n");
  EXPECT_EQ(read_intrinsics(file()), (CameraIntrinsics{585.5, 586, 320, 240.25}));
}

TEST_F(IntrinsicsTest, TheFileGoesBeforeTheConfig) {
  write_text(file(), "585 0 320 0 586 240 0 0 1");
  EXPECT_EQ(found(given(1, 2, 3, 4)), (CameraIntrinsics{585, 586, 320, 240}));
  EXPECT_THAT(warnings_, testing::IsEmpty());
}

TEST_F(IntrinsicsTest, TheConfigGoesBeforeTheDefault) {
  EXPECT_EQ(found(given(500, 501, 300, 200)), (CameraIntrinsics{500, 501, 300, 200}));
  EXPECT_THAT(warnings_, testing::IsEmpty());
}

TEST_F(IntrinsicsTest, TheDefaultIsTheMiddleAndToldAsAWarning) {
  EXPECT_EQ(found(), (CameraIntrinsics{525, 525, 319.5, 239.5}));
  EXPECT_THAT(warnings_, testing::ElementsAre(
                             folder_.path().string() +
                             ": no camera-intrinsics.txt and no capture.camera: taking a focal "
                             "length of 525 px and the middle of the image"));
}

TEST_F(IntrinsicsTest, FilesThatHoldNoMatrix) {
  std::string const nine = "needs nine numbers, a 3x3 camera matrix";
  EXPECT_EQ(error_of(""), nine);
  EXPECT_EQ(error_of("585 0 320 0 585 240 0 0"), nine);
  EXPECT_EQ(error_of("585 0 320 0 nan 240 0 0 1"), nine);
  EXPECT_EQ(error_of("fx 585"), nine);
  EXPECT_EQ(error_of("585 0 320 0 585 240 0 0 1 0"),
            "has more than nine numbers, a 3x3 camera matrix");
}

TEST_F(IntrinsicsTest, MatricesOfNoPinholeCamera) {
  std::string const none = "not a pinhole camera matrix (fx 0 cx, 0 fy cy, 0 0 1)";
  EXPECT_EQ(error_of("-585 0 320 0 585 240 0 0 1"), none);
  EXPECT_EQ(error_of("585 0 320 0 0 240 0 0 1"), none);
  EXPECT_EQ(error_of("585 3 320 0 585 240 0 0 1"), none) << "skew";
  EXPECT_EQ(error_of("585 0 320 0 585 240 0 0 2"), none);
  EXPECT_EQ(error_of("585 0 0 0 585 0 320 240 1"), none) << "transposed";
}

TEST_F(IntrinsicsTest, IntrinsicsOfAnotherResolution) {
  EXPECT_EQ(error_of("1050 0 960 0 1050 540 0 0 1"),
            "principal point (960, 540) is not in the 640x480 image: intrinsics of another "
            "resolution?");
  std::filesystem::remove(file());
  EXPECT_EQ(error_of(given(1050, 1050, 300, 540), "capture.camera: "),
            "principal point (300, 540) is not in the 640x480 image: intrinsics of another "
            "resolution?");
}

TEST_F(IntrinsicsTest, AConfigThatGivesSomeOfFour) {
  EXPECT_EQ(error_of(given(525, 525, 0, 0), "capture.camera: "),
            "give all four of fx_px, fy_px, cx_px, cy_px, or none");
}

}  // namespace
}  // namespace credo
