#include "io/pcd.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <fstream>
#include <sstream>
#include <tuple>

#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::TempFolder;
using test::write_text;

constexpr float kFarM = 100.0F;

/// A header for 2x2 points, up to the line DATA.
std::string header(
    std::string const& fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n",
    std::string const& size = "WIDTH 2\nHEIGHT 2\n", std::string const& points = "POINTS 4\n") {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields + size +
         "VIEWPOINT 0 0 0 1 0 0 0\n" + points;
}

constexpr char kFourPoints[] = "1 2 3\n4 5 6\n7 8 9\n10 11 12\n";

std::string content_of(std::filesystem::path const& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class PcdTest : public testing::Test {
protected:
  ColoredCloud cloud_of(std::string const& text, CloudAxes axes = CloudAxes::kAuto,
                        double max_depth_m = kFarM) {
    write_text(path(), text);
    return read_pcd(path(), axes, max_depth_m);
  }
  /// The error for a file with this text, without the path, which must come first.
  std::string error_of(std::string const& text) {
    try {
      cloud_of(text);
    } catch (InputError const& error) {
      std::string const message = error.what();
      EXPECT_EQ(message.rfind(path().string() + ": ", 0), 0U) << message;
      return message.substr(path().string().size() + 2);
    }
    return "no error";
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "a.pcd"; }

  TempFolder folder_;
};

Eigen::Vector3f point(ColoredCloud const& cloud, std::size_t i) {
  return cloud.cloud_camera.at(i);
}

TEST_F(PcdTest, ReadsWhatPclWritesInEveryEncoding) {
  pcl::PointCloud<pcl::PointXYZRGB> written(3, 2);
  for (std::size_t i = 0; i < written.size(); ++i) {
    auto const f = static_cast<float>(i);
    written[i] =
        pcl::PointXYZRGB(0.1F * f, -0.5F, 1.0F + f, static_cast<std::uint8_t>(i), 100, 255);
  }
  written(1, 0).z = kNaN;
  pcl::PCDWriter writer;
  for (std::string const encoding : {"ascii", "binary", "compressed"}) {
    if (encoding == "ascii") {
      writer.writeASCII(path().string(), written);
    } else if (encoding == "binary") {
      writer.writeBinary(path().string(), written);
    } else {
      writer.writeBinaryCompressed(path().string(), written);
    }
    ColoredCloud const read = read_pcd(path(), CloudAxes::kAuto, kFarM);
    ASSERT_EQ(read.cloud_camera.width(), 3) << encoding;
    ASSERT_EQ(read.cloud_camera.height(), 2) << encoding;
    for (std::size_t i = 0; i < written.size(); ++i) {
      EXPECT_EQ(read.cloud_camera.valid(i), i != 1) << encoding << " " << i;
      if (i != 1) {
        EXPECT_EQ(point(read, i), written[i].getVector3fMap()) << encoding << " " << i;
      }
      EXPECT_EQ(read.color[i], (Rgb{static_cast<std::uint8_t>(i), 100, 255})) << encoding;
    }
  }
}

TEST_F(PcdTest, ColourIsOptional) {
  ColoredCloud const cloud = cloud_of(header() + "DATA ascii\n" + kFourPoints);
  EXPECT_TRUE(cloud.color.empty());
  EXPECT_EQ(point(cloud, 3), Eigen::Vector3f(10, 11, 12));
}

TEST_F(PcdTest, TakesColourFromAnIntegerAmongOtherFields) {
  ColoredCloud const cloud = cloud_of(
      header("FIELDS label x y z rgba\nSIZE 4 4 4 4 4\nTYPE U F F F U\nCOUNT 1 1 1 1 1\n") +
      "DATA ascii\n7 1 2 3 4278255361\n7 1 2 3 0\n7 1 2 3 255\n7 1 2 3 65280\n");
  EXPECT_EQ(point(cloud, 0), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.color[0], (Rgb{0, 0xFF, 0x01}));  // 0xFF00FF01, alpha first
  EXPECT_EQ(cloud.color[2], (Rgb{0, 0, 255}));
}

TEST_F(PcdTest, InvalidPointsAreNanInAllThree) {
  ColoredCloud const cloud =
      cloud_of(header() + "DATA ascii\n1 1 2\n0 0 0\nnan 1 1\n1 1 -1\n", CloudAxes::kAuto, 1.5);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(point(cloud, i).array().isNaN().all()) << i;
  }
}

TEST_F(PcdTest, AllNanIsACloudOfNothing) {
  ColoredCloud const cloud =
      cloud_of(header() + "DATA ascii\nnan nan nan\nnan nan nan\nnan nan nan\nnan nan nan\n");
  EXPECT_EQ(cloud.cloud_camera.size(), 4U);
  EXPECT_FALSE(cloud.cloud_camera.valid(0));
}

TEST_F(PcdTest, TurnsYUpZBackToTheOpticalFrame) {
  std::string const behind = header() + "DATA ascii\n1 2 -3\n1 1 -1\nnan nan nan\n1 1 1\n";
  EXPECT_EQ(point(cloud_of(behind), 0), Eigen::Vector3f(1, -2, 3)) << "most points are behind";
  EXPECT_EQ(point(cloud_of(behind, CloudAxes::kYUpZBack), 0), Eigen::Vector3f(1, -2, 3));
  EXPECT_FALSE(cloud_of(behind, CloudAxes::kOptical).cloud_camera.valid(0));
  EXPECT_EQ(point(cloud_of(behind, CloudAxes::kOptical), 3), Eigen::Vector3f(1, 1, 1));
}

TEST_F(PcdTest, HeadersThatSayTooLittle) {
  std::string const none = "not a PCD file: its header needs FIELDS, WIDTH, HEIGHT and DATA";
  EXPECT_EQ(error_of(""), none);
  EXPECT_EQ(error_of("hello\n"), none);
  EXPECT_EQ(error_of(std::string(100'000, '\n')), none);
  EXPECT_EQ(error_of(header()), none) << "no DATA";
  EXPECT_EQ(error_of(header("") + "DATA ascii\n"), none);
  EXPECT_THROW(read_pcd(folder_ / "none.pcd", CloudAxes::kAuto, kFarM), InputError);
}

TEST_F(PcdTest, HeadersThatContradictThemselves) {
  EXPECT_EQ(error_of(header("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nCOUNT 1 1 1\n") + "DATA ascii\n"),
            "damaged PCD header: FIELDS, SIZE and COUNT differ in length");
  EXPECT_EQ(
      error_of(header("FIELDS x y z\nSIZE 4 4 0\nTYPE F F F\nCOUNT 1 1 1\n") + "DATA ascii\n"),
      "damaged PCD header: a field of 1 times 0 bytes");
  EXPECT_EQ(error_of(header("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n",
                            "WIDTH 2\nHEIGHT 2\n", "POINTS 5\n") +
                     "DATA ascii\n"),
            "damaged PCD header: 5 POINTS for 2x2");
  EXPECT_EQ(error_of(header("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n",
                            "WIDTH 99999\nHEIGHT 480\n", "POINTS 47999520\n") +
                     "DATA binary\n"),
            "damaged PCD header: claims 99999x480 points");
  EXPECT_EQ(error_of(header() + "DATA braille\n"), "damaged PCD header: DATA braille");
}

TEST_F(PcdTest, CloudsThatAreNoImages) {
  EXPECT_EQ(error_of(header("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n",
                            "WIDTH 4\nHEIGHT 1\n") +
                     "DATA ascii\n" + kFourPoints),
            "not organised (4x1): an image of points is needed");
}

TEST_F(PcdTest, PointsAreReadOfAnyCloud) {
  std::string const one_row =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
      "TYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nVIEWPOINT 0.5 -1 2 1 0 0 0\nPOINTS 4\n"
      "DATA ascii\n";
  write_text(path(), one_row + "1 2 3\nnan nan nan\n0 0 0\n-4 5 -6\n");
  ViewedPoints const viewed = read_pcd_points(path(), CloudAxes::kOptical);
  EXPECT_EQ(viewed.viewpoint, Eigen::Vector3f(0.5F, -1.0F, 2.0F));
  EXPECT_THAT(viewed.points, testing::ElementsAre(Eigen::Vector3f(1.0F, 2.0F, 3.0F),
                                                  Eigen::Vector3f(-4.0F, 5.0F, -6.0F)));
  write_text(path(), header() + "DATA ascii\n" + kFourPoints);
  EXPECT_EQ(read_pcd_points(path(), CloudAxes::kAuto).points.size(), 4U);
}

TEST_F(PcdTest, PointsAreTurnedAsCloudsAre) {
  std::string const behind =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n"
      "VIEWPOINT 0.5 -1 2 1 0 0 0\nPOINTS 3\nDATA ascii\n1 2 -3\n1 2 3\n-4 5 -6\n";
  write_text(path(), behind);
  for (CloudAxes const axes : {CloudAxes::kAuto, CloudAxes::kYUpZBack}) {
    ViewedPoints const viewed = read_pcd_points(path(), axes);
    EXPECT_EQ(viewed.points.at(0), Eigen::Vector3f(1.0F, -2.0F, 3.0F));
    EXPECT_EQ(viewed.viewpoint, Eigen::Vector3f(0.5F, 1.0F, -2.0F));
  }
  EXPECT_EQ(read_pcd_points(path(), CloudAxes::kOptical).points.at(0),
            Eigen::Vector3f(1.0F, 2.0F, -3.0F));
}

TEST_F(PcdTest, PointsOfBadFilesAreRefused) {
  auto const points_error = [&](std::string const& text) {
    write_text(path(), text);
    try {
      std::ignore = read_pcd_points(path(), CloudAxes::kAuto);
    } catch (InputError const& error) {
      return std::string(error.what()).substr(path().string().size() + 2);
    }
    return std::string("no error");
  };
  std::string const fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  EXPECT_EQ(points_error(header(fields, "WIDTH 4\nHEIGHT 1\n") + "DATA ascii\n1 2 3\n4 5 6\n"),
            "cut short, has 2 of 4 points");
  EXPECT_EQ(points_error(header(fields, "WIDTH 67108865\nHEIGHT 1\n", "POINTS 67108865\n") +
                         "DATA binary\n"),
            "damaged PCD header: claims 67108865x1 points");
  EXPECT_EQ(
      points_error(header(fields, "WIDTH 8192\nHEIGHT 18446744073709551615\n") + "DATA binary\n"),
      "damaged PCD header: claims 8192x18446744073709551615 points");
  EXPECT_EQ(points_error(header("FIELDS x y w\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n") +
                         "DATA ascii\n" + kFourPoints),
            "needs float fields x y z");
}

TEST_F(PcdTest, CloudsWithoutCoordinates) {
  EXPECT_EQ(error_of(header("FIELDS x y w\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n") +
                     "DATA ascii\n" + kFourPoints),
            "needs float fields x y z");
  EXPECT_EQ(error_of(header("FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\n") +
                     "DATA ascii\n" + kFourPoints),
            "needs float fields x y z")
      << "doubles";
}

TEST_F(PcdTest, AColourOfOneByteIsNoColour) {
  ColoredCloud const cloud =
      cloud_of(header("FIELDS x y z rgb\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 1\n") +
               "DATA ascii\n1 2 3 4\n1 2 3 4\n1 2 3 4\n1 2 3 4\n");
  EXPECT_TRUE(cloud.color.empty());
}

TEST_F(PcdTest, CutData) {
  for (std::string const kind : {"ascii", "binary", "binary_compressed"}) {
    EXPECT_EQ(error_of(header() + "DATA " + kind), "cut short, ends with its header");
  }
  std::string const binary = header() + "DATA binary\n";
  auto const size = std::to_string(binary.size() + 20);
  EXPECT_EQ(error_of(binary + std::string(20, 'x')),
            "cut short, has " + size + " of " + std::to_string(binary.size() + 48) + " bytes");
  EXPECT_EQ(error_of(header() + "DATA ascii\n1 2 3\n4 5 6\n\n7 8 9\n"),
            "cut short, has 3 of 4 points");
  EXPECT_EQ(error_of(header() + "DATA ascii\n1 2 3\n4 5 na"), "cut short, has 1 of 4 points");
  EXPECT_EQ(error_of(header() + "DATA ascii\n1 2 3\n4 5 6\n7 8 9\n10 11\n"),
            "damaged PCD data: point 3 has 2 values, 3 expected");
}

TEST_F(PcdTest, DataThatAreNoNumbers) {
  EXPECT_EQ(error_of(header() + "DATA ascii\n1 2 3\n4 five 6\n7 8 9\n10 11 12\n"),
            "damaged PCD data: 'five' is no number");
}

TEST_F(PcdTest, NoPrefixOfACompressedCloudIsACloud) {
  pcl::PCDWriter().writeBinaryCompressed(path().string(),
                                         pcl::PointCloud<pcl::PointXYZ>(6, 5, {1, 2, 3}));
  std::string const whole = content_of(path());
  ASSERT_EQ(error_of(whole), "no error");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(error_of(whole.substr(0, length)), "no error") << length << " of " << whole.size();
  }
}

TEST_F(PcdTest, ACompressedCloudMustUnpackToItsSize) {
  pcl::PCDWriter().writeBinaryCompressed(path().string(),
                                         pcl::PointCloud<pcl::PointXYZ>(6, 5, {1, 2, 3}));
  std::string bytes = content_of(path());
  std::string const data_line = "DATA binary_compressed\n";
  std::size_t const lengths = bytes.find(data_line) + data_line.size();
  bytes[lengths + 4] = 100;  // of 6 * 5 * 12 = 360, which is 0x168
  EXPECT_EQ(error_of(bytes), "damaged PCD data: unpacks to 356 bytes, 360 expected");
}

TEST_F(PcdTest, PclKeepsSilentOnDamagedFiles) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  error_of(header() + "DATA ascii\n1 2 3\n4 5 6\n7 8 9\n10\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(PcdTest, LabelsAreReadWhereThereAreSome) {
  std::string const with_labels =
      header("FIELDS label x y z\nSIZE 4 4 4 4\nTYPE U F F F\nCOUNT 1 1 1 1\n");
  write_text(path(), with_labels + "DATA ascii\n0 1 2 3\n21 4 5 6\n1 7 8 9\n65535 nan nan nan\n");
  auto const labels = read_pcd_labels(path());
  ASSERT_TRUE(labels);
  EXPECT_EQ(labels->width(), 2);
  EXPECT_EQ((*labels)[0], 0);
  EXPECT_EQ((*labels)[1], 21);
  EXPECT_EQ((*labels)[2], 1);
  EXPECT_EQ((*labels)[3], 65535);
  write_text(path(), header() + "DATA ascii\n" + kFourPoints);
  EXPECT_FALSE(read_pcd_labels(path()));
  write_text(path(), with_labels + "DATA ascii\n0 1 2 3\n70000 4 5 6\n1 7 8 9\n1 1 1 1\n");
  EXPECT_THROW(read_pcd_labels(path()), InputError);
}

}  // namespace
}  // namespace credo
