#include "io/dataset.hpp"
#include "io/dataset_fixture.hpp"

namespace credo {
namespace {

using test::cut_file;
using test::kHeight;
using test::kWidth;
using test::some_color;
using test::some_depth;
using test::write_text;

// What is wrong from the start is said at open.

class OpenErrorTest : public test::DatasetTest {
protected:
  static PoseConfig poses_of(std::filesystem::path const& file) {
    PoseConfig pose;
    pose.source = PoseSource::kFile;
    pose.file = file.string();
    return pose;
  }
};

TEST_F(OpenErrorTest, NoFolder) {
  try {
    open_dataset("/nowhere/at/all", {}, {});
    FAIL();
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "dataset /nowhere/at/all: no such folder");
  }
}

TEST_F(OpenErrorTest, AFileInPlaceOfAFolder) {
  write_text(folder_ / "file", "");
  try {
    open_dataset(folder_ / "file", {}, {});
    FAIL();
  } catch (InputError const& error) {
    EXPECT_EQ(without_folder(error.what()), "dataset /file: not a folder");
  }
}

TEST_F(OpenErrorTest, NothingKnownInIt) {
  std::string const text =
      "dataset : no frames found; known are frame-NNNNNN.depth.png with .color.jpg|png, "
      "NNNN.depth.png with .color.png, TUM depth.txt with rgb.txt, and *.pcd";
  EXPECT_EQ(open_error(), text);
  write_text(folder_ / "holiday.png", "");
  EXPECT_EQ(open_error(), text);
  write_text(folder_ / "depth.txt", "# no lines\n");
  write_text(folder_ / "rgb.txt", "");
  EXPECT_EQ(open_error(), text);
}

TEST_F(OpenErrorTest, BadIntrinsics) {
  write_three();
  write_text(folder_ / "camera-intrinsics.txt", "500 0 15.5 0 500");
  EXPECT_EQ(open_error(), "/camera-intrinsics.txt: needs nine numbers, a 3x3 camera matrix");
}

TEST_F(OpenErrorTest, FirstFrameUnreadable) {
  write_three();
  write_text(file(0, "depth.png"), "");
  EXPECT_EQ(open_error(), "/frame-000000.depth.png: empty file");
}

TEST_F(OpenErrorTest, DepthOnly) {
  write_three();
  for (int i = 0; i < 3; ++i) {
    std::filesystem::remove(file(i, "color.png"));
  }
  EXPECT_EQ(open_error(), "/frame-000000.depth.png: depth without colour");
}

TEST_F(OpenErrorTest, FirstPoseMissing) {
  write_three();
  std::filesystem::remove(file(0, "pose.txt"));
  EXPECT_EQ(open_error(), ": no pose for frame 0; pose.source=fixed runs without poses");
}

TEST_F(OpenErrorTest, BadCloud) {
  write_text(folder_ / "a.pcd", "hello\n");
  EXPECT_EQ(open_error(),
            "/a.pcd: not a PCD file: its header needs FIELDS, WIDTH, HEIGHT and DATA");
}

TEST_F(OpenErrorTest, BadTrajectory) {
  write_three();
  EXPECT_EQ(open_error(poses_of("")), "pose.source is file, but pose.file names none");
  EXPECT_EQ(open_error(poses_of(folder_ / "none.txt")), "/none.txt: trajectory cannot be read");
  write_text(folder_ / "bad.txt", "0 0 0 0 0 0 0 1\nhello\n");
  EXPECT_EQ(open_error(poses_of(folder_ / "bad.txt")), "/bad.txt:2: 'hello' is no number");
}

TEST_F(OpenErrorTest, BadTumLists) {
  write_tum_images();
  write_text(folder_ / "rgb.txt", "1 c0.png\n");
  write_text(folder_ / "depth.txt", "# ok\nd0.png\n");
  EXPECT_EQ(open_error(), "/depth.txt:2: needs a stamp in seconds and a file name");
  write_text(folder_ / "depth.txt", "1\n");
  EXPECT_EQ(open_error(), "/depth.txt:1: needs a stamp in seconds and a file name");
  write_text(folder_ / "depth.txt", "1e300 d0.png\n");
  EXPECT_EQ(open_error(), "/depth.txt:1: needs a stamp in seconds and a file name");
  write_text(folder_ / "depth.txt", "2 d0.png\n1 d1.png\n");
  EXPECT_EQ(open_error(), "/depth.txt:2: stamp falls");
}

TEST_F(OpenErrorTest, TumStreamsThatNeverMeet) {
  write_tum_images();
  write_text(folder_ / "depth.txt", "1 d0.png\n");
  write_text(folder_ / "rgb.txt", "2 c0.png\n");
  EXPECT_EQ(open_error(), "/d0.png: depth without colour");
  write_text(folder_ / "rgb.txt", "1 c0.png\n");
  write_text(folder_ / "groundtruth.txt", "2 0 0 0 0 0 0 1\n");
  EXPECT_EQ(open_error(), ": no pose for frame 0; pose.source=fixed runs without poses");
}

// What goes wrong later costs the frame.

class LostFrameTest : public test::DatasetTest {
protected:
  void SetUp() override { write_three(); }

  /// Frame 1 is lost for this reason and with this text; frames 0 and 2 are good.
  void expect_lost(std::string const& reason, std::string const& text) const {
    OpenedSource const opened = open();
    EXPECT_EQ(opened.frame_count, 3U);
    EXPECT_TRUE(std::holds_alternative<FramePtr>(opened.source->next()));
    SourceResult const second = opened.source->next();
    ASSERT_TRUE(std::holds_alternative<FrameFailure>(second));
    auto const& failure = std::get<FrameFailure>(second);
    EXPECT_EQ(number(failure.index), 1);
    EXPECT_EQ(failure.reason, reason);
    EXPECT_EQ(without_folder(failure.message), text);
    SourceResult const third = opened.source->next();
    ASSERT_TRUE(std::holds_alternative<FramePtr>(third));
    EXPECT_EQ(number(std::get<FramePtr>(third)->index), 2);
    EXPECT_TRUE(std::holds_alternative<EndOfSource>(opened.source->next()));
  }
};

TEST_F(LostFrameTest, MissingColour) {
  std::filesystem::remove(file(1, "color.png"));
  expect_lost("missing_color", "/frame-000001.depth.png: depth without colour");
}
TEST_F(LostFrameTest, MissingDepth) {
  std::filesystem::remove(file(1, "depth.png"));
  expect_lost("missing_depth", "/frame-000001.color.png: colour without depth");
}
TEST_F(LostFrameTest, MissingPose) {
  std::filesystem::remove(file(1, "pose.txt"));
  expect_lost("missing_pose", ": no pose for frame 1; pose.source=fixed runs without poses");
}
TEST_F(LostFrameTest, CutDepth) {
  cut_file(file(1, "depth.png"), 0.6);
  expect_lost("truncated_image", "/frame-000001.depth.png: cut short");
}
TEST_F(LostFrameTest, CutColour) {
  cut_file(file(1, "color.png"), 0.5);
  expect_lost("truncated_image", "/frame-000001.color.png: cut short");
}
TEST_F(LostFrameTest, EmptyFile) {
  write_text(file(1, "color.png"), "");
  expect_lost("truncated_image", "/frame-000001.color.png: empty file");
}
TEST_F(LostFrameTest, NotAnImage) {
  write_text(file(1, "color.png"), "this is no image");
  expect_lost("unreadable_image", "/frame-000001.color.png: neither PNG nor JPEG");
}
TEST_F(LostFrameTest, DepthOfEightBits) {
  write_png_rgb(file(1, "depth.png"), some_color());
  expect_lost("unreadable_image",
              "/frame-000001.depth.png: not a 16-bit grey PNG (8 bits, colour type 2)");
}
TEST_F(LostFrameTest, DepthOfAnotherSize) {
  write_png16(file(1, "depth.png"), some_depth(16, kHeight));
  expect_lost("wrong_size", "/frame-000001.depth.png: is 16x24, the first frame is 32x24");
}
TEST_F(LostFrameTest, ColourOfAnotherSize) {
  write_png_rgb(file(1, "color.png"), some_color(2 * kWidth, 2 * kHeight));
  expect_lost("wrong_size", "/frame-000001.color.png: is 64x48, its depth 32x24");
}
TEST_F(LostFrameTest, PoseWithFifteenNumbers) {
  write_text(file(1, "pose.txt"), "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0");
  expect_lost("bad_pose", "/frame-000001.pose.txt: needs 16 numbers, has 15");
}
TEST_F(LostFrameTest, PoseWithNan) {
  write_text(file(1, "pose.txt"), "1 0 0 nan 0 1 0 0 0 0 1 0 0 0 0 1");
  expect_lost("bad_pose", "/frame-000001.pose.txt: pose has a number that is not finite");
}
TEST_F(LostFrameTest, PoseThatIsNoRotation) {
  write_text(file(1, "pose.txt"), "2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1");
  expect_lost("bad_pose", "/frame-000001.pose.txt: the 3x3 part of the pose is not a rotation");
}

TEST(LostCloudTest, CostsItsFrame) {
  test::TempFolder const folder;
  std::string const head =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n";
  std::string const good = head + "HEIGHT 2\nPOINTS 4\nDATA ascii\n0 0 1\n0 0 1\n0 0 1\n0 0 1\n";
  write_text(folder / "0.pcd", good);
  write_text(folder / "1.pcd", good.substr(0, good.size() - 10));
  write_text(folder / "2.pcd", head +
                                   "HEIGHT 3\nPOINTS 6\nDATA ascii\n0 0 1\n0 0 1\n0 0 1\n"
                                   "0 0 1\n0 0 1\n0 0 1\n");
  write_text(folder / "3.pcd", good);
  OpenedSource const opened = open_dataset(folder.path(), {}, {});
  EXPECT_TRUE(std::holds_alternative<FramePtr>(opened.source->next()));
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "bad_cloud");
  EXPECT_EQ(std::get<FrameFailure>(opened.source->next()).reason, "wrong_size");
  EXPECT_TRUE(std::holds_alternative<FramePtr>(opened.source->next()));
}

}  // namespace
}  // namespace credo
