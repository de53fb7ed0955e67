#include "drivers/virtual/sensor_images.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "drivers/virtual/plain_dataset.hpp"
#include "io/dataset_writer.hpp"

namespace credo::test {
namespace {

using ::testing::HasSubstr;

TEST(SensorDataset, ReadsWhatIsInTheFolder) {
  TempFolder folder;
  write_dataset(folder.path(), 3);
  SensorDataset const dataset(folder.path());
  EXPECT_EQ(dataset.count(), 3U);
  EXPECT_EQ(dataset.width(), kWidth);
  EXPECT_EQ(dataset.height(), kHeight);
  EXPECT_EQ(dataset.intrinsics(), (CameraIntrinsics{60, 60, 31.5, 23.5}));
  for (std::size_t i = 0; i < 3; ++i) {
    SensorImages const images = dataset.read(i);
    EXPECT_EQ(images.depth_mm, depth_of(i));
    EXPECT_EQ(images.color, color_of(i));
  }
}

// TUM's counts are fifths of a millimetre; a Kinect knows nothing beyond 10 m.
TEST(SensorDataset, CountsWholeMillimetresUpToTenMetres) {
  TempFolder folder;
  Frame frame;
  frame.cloud_camera =
      cloud_from_depth(Grid<float>(4, 1, {1.2344F, 10.0F, 10.0012F, 0.0F}), frame.intrinsics);
  frame.color = Grid<Rgb>(4, 1);
  frame.intrinsics = {525, 525, 1.5, 0};
  DatasetWriter(folder / "tum").write(frame);
  SensorImages const images = SensorDataset(folder / "tum").read(0);
  EXPECT_EQ(images.depth_mm, Grid<std::uint16_t>(4, 1, {1234, 10000, 0, 0}));

  Grid<std::uint16_t> depth = depth_of(0);
  depth[0] = 65535;
  write_dataset(folder / "mm", 1);
  write_png16(image_file(folder / "mm", 0, "depth"), depth);
  EXPECT_EQ(SensorDataset(folder / "mm").read(0).depth_mm[0], 0);
}

std::string error_of(std::filesystem::path const& folder, std::size_t image = 0) {
  try {
    static_cast<void>(SensorDataset(folder).read(image));
  } catch (InputError const& error) {
    return error.what();
  }
  return "no error";
}

TEST(SensorDataset, SaysWhatItCannotPlay) {
  TempFolder folder;
  EXPECT_THAT(error_of(folder / "none"), HasSubstr("none: no such folder"));

  write_dataset(folder / "a", 3);
  write_png16(image_file(folder / "a", 1, "depth"), Grid<std::uint16_t>(2, 2));
  write_png_rgb(image_file(folder / "a", 1, "color"), Grid<Rgb>(2, 2));
  EXPECT_THAT(error_of(folder / "a", 1),
              HasSubstr("0001.depth.png: depth is 2x2, colour 2x2, the first frame 64x48; all must "
                        "be alike"));
  write_png16(image_file(folder / "a", 1, "depth"), depth_of(1));
  EXPECT_THAT(error_of(folder / "a", 1),
              HasSubstr("depth is 64x48, colour 2x2; all must be alike"));
  std::filesystem::remove(image_file(folder / "a", 2, "color"));
  EXPECT_THAT(error_of(folder / "a", 2), HasSubstr("0002.depth.png: its colour is missing"));
  std::filesystem::remove(image_file(folder / "a", 0, "depth"));
  EXPECT_THAT(error_of(folder / "a"), HasSubstr("0000.color.png: its depth is missing"));

  std::filesystem::create_directories(folder / "clouds");
  write_text(folder / "clouds" / "a.pcd", "");
  EXPECT_THAT(error_of(folder / "clouds"),
              HasSubstr("a.pcd: is a cloud; a virtual sensor plays depth and colour images"));
}

TEST(Unregistered, EqualsTheObviousWay) {
  for (std::size_t image = 0; image < 3; ++image) {
    EXPECT_EQ(unregistered(depth_of(image), {kFocal_px, kFocal_px, 31.5, 23.5}),
              literally_unregistered(depth_of(image)));
  }
}

// 575.8 px * 25 mm / 7198 mm = 2 px to the right; what is nearer hides what is farther.
TEST(Unregistered, IsWhatAKinectsInfraredCameraSees) {
  CameraIntrinsics const color{525, 525, 4, 0};
  EXPECT_NEAR(infrared_of(color).fx_px, 575.8, 1e-9);
  EXPECT_NEAR(infrared_of(color).fy_px, 575.8, 1e-9);
  EXPECT_EQ(infrared_of(color).cx_px, 4);
  Grid<std::uint16_t> depth_mm(9, 1, std::uint16_t{0});
  depth_mm[4] = 7198;
  EXPECT_EQ(unregistered(depth_mm, color),
            Grid<std::uint16_t>(9, 1, {0, 0, 0, 0, 0, 0, 7198, 0, 0}));
  // Two pixels left of the middle are 2.2 in the longer lens; 4 px to the right of that is 5.8.
  depth_mm[2] = 3599;
  EXPECT_EQ(unregistered(depth_mm, color),
            Grid<std::uint16_t>(9, 1, {0, 0, 0, 0, 0, 0, 3599, 0, 0}));
  EXPECT_TRUE(unregistered({}, color).empty());
}

}  // namespace
}  // namespace credo::test
