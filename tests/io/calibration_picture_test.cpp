#include "io/calibration_picture.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "io/palette.hpp"

namespace credo::test {
namespace {

/// A grey wall 2 m ahead; the upper half is labelled.
Frame grey_frame() {
  Frame frame;
  frame.intrinsics = {40.0, 40.0, 31.5, 23.5};
  frame.cloud_camera = cloud_from_depth(Grid<float>(64, 48, 2.0F), frame.intrinsics);
  frame.color = Grid<Rgb>(64, 48, Rgb{100, 100, 100});
  frame.color_registered = true;
  return frame;
}

LabelMap labels() {
  LabelMap result(64, 48, kUnassigned);
  result[Pixel{5, 5}] = kFloor;
  result[Pixel{6, 5}] = kFirstWall;
  return result;
}

/// So high up, looking at the horizon, that the floor's lines lie low in the picture.
Se3 looking_along_y() {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitX())),
          {0.0, 0.0, 1.0}};
}

TEST(DrawCalibration, TintsFloorAndWall) {
  Grid<Rgb> const picture = draw_calibration(grey_frame(), labels(), looking_along_y());
  ASSERT_EQ(picture.width(), 64);
  ASSERT_EQ(picture.height(), 48);
  EXPECT_EQ((picture[Pixel{5, 5}]), mixed({100, 100, 100}, kRed, 0.5));
  EXPECT_EQ((picture[Pixel{6, 5}]), mixed({100, 100, 100}, kPink, 0.5));
  EXPECT_EQ((picture[Pixel{7, 5}]), (Rgb{100, 100, 100}));
}

TEST(DrawCalibration, LaysTheFloorsSquaresBelowTheHorizonOnly) {
  Grid<Rgb> const picture = draw_calibration(grey_frame(), labels(), looking_along_y());
  int above = 0;
  int below = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    int const changed = picture[i] == Rgb{100, 100, 100} ? 0 : 1;
    (picture.pixel(i).v < 24 ? above : below) += changed;
  }
  EXPECT_EQ(above, 2) << "the tinted pixels";
  EXPECT_GT(below, 50);
}

TEST(DrawCalibration, ShowsDepthWhereColourIsOfAnotherPlace) {
  Frame frame = grey_frame();
  frame.color_registered = false;
  EXPECT_EQ((draw_calibration(frame, labels(), looking_along_y())[Pixel{7, 5}]), depth_grey(2.0F));
  frame.color_registered = true;
  frame.color = {};
  EXPECT_EQ((draw_calibration(frame, labels(), looking_along_y())[Pixel{7, 5}]), depth_grey(2.0F));
}

TEST(DrawCalibration, OfNothingIsNothing) {
  EXPECT_TRUE(draw_calibration({}, {}, {}).empty());
}

}  // namespace
}  // namespace credo::test
