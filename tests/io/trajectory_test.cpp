#include "io/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::TempFolder;
using test::write_text;

constexpr std::int64_t kMs = 1'000'000;

class TrajectoryTest : public testing::Test {
protected:
  Trajectory trajectory(std::string const& text) {
    write_text(folder_ / "path.txt", text);
    return Trajectory(folder_ / "path.txt");
  }
  /// The error for this text without the path, which must come first.
  template <typename Read>
  std::string error_of(Read read, std::string const& text) {
    auto const path = folder_ / "path.txt";
    write_text(path, text);
    try {
      read(path);
    } catch (InputError const& error) {
      std::string const message = error.what();
      EXPECT_EQ(message.rfind(path.string() + ":", 0), 0U) << message;
      return message.substr(path.string().size() + 1);
    }
    return "no error";
  }
  std::string pose_error(std::string const& text) { return error_of(read_pose, text); }
  std::string trajectory_error(std::string const& text) {
    return error_of([](auto const& path) { Trajectory{path}; }, text);
  }

  TempFolder folder_;
};

/// The x position at a stamp, or NaN where there is no pose.
double x_at(Trajectory const& trajectory, std::int64_t stamp_ns) {
  auto const pose = trajectory.at(FrameIndex{0}, stamp_ns);
  return pose ? pose->translation().x() : std::numeric_limits<double>::quiet_NaN();
}

TEST_F(TrajectoryTest, ReadsAPoseRowByRow) {
  write_text(folder_ / "pose.txt", "0 -1 0 1.5\n1 0 0 -2e-1\n0 0 1 3\n0 0 0 1\n");
  Se3 const pose = read_pose(folder_ / "pose.txt");
  EXPECT_TRUE((pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1.5, 0.8, 3), 1e-12));
}

TEST_F(TrajectoryTest, APoseMayBeOffByRounding) {
  write_text(folder_ / "pose.txt", "0.99998 0 0 0 0 1.00002 0 0 0 0 1 0 0 0 0 1");
  EXPECT_NEAR(read_pose(folder_ / "pose.txt").rotation().norm(), 1.0, 1e-12);
}

TEST_F(TrajectoryTest, TinyNumbersAreNumbers) {
  write_text(folder_ / "pose.txt", "1 0 0 1e-320 0 1 0 0 0 0 1 0 0 0 0 1");
  EXPECT_NEAR(read_pose(folder_ / "pose.txt").translation().x(), 0.0, 1e-300);
}

TEST_F(TrajectoryTest, BadPosesSayWhy) {
  EXPECT_EQ(pose_error(""), " needs 16 numbers, has 0");
  EXPECT_EQ(pose_error("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0"), " needs 16 numbers, has 15");
  EXPECT_EQ(pose_error("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1"), " needs 16 numbers, has 17");
  EXPECT_EQ(pose_error("1 0 0 O 0 1 0 0 0 0 1 0 0 0 0 1"), " 'O' is no number");
  EXPECT_EQ(pose_error("1 0 0 1,5 0 1 0 0 0 0 1 0 0 0 0 1"), " '1,5' is no number");
  EXPECT_EQ(pose_error("1 0 0 nan 0 1 0 0 0 0 1 0 0 0 0 1"),
            " pose has a number that is not finite");
  EXPECT_EQ(pose_error("1 0 0 1e999 0 1 0 0 0 0 1 0 0 0 0 1"),
            " pose has a number that is not finite");
  EXPECT_EQ(pose_error("2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1"),
            " the 3x3 part of the pose is not a rotation");
  EXPECT_EQ(pose_error("-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"),
            " the 3x3 part of the pose is not a rotation")
      << "a mirror";
  EXPECT_EQ(pose_error("1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1"), " last row of the pose is not 0 0 0 1");
  EXPECT_THROW(read_pose(folder_ / "none.txt"), InputError);
}

TEST_F(TrajectoryTest, InterpolatesBetweenStamps) {
  // From the origin to x = 1, turning by 90 degrees about z.
  Trajectory const t = trajectory(
      "# stamp tx ty tz qx qy qz qw\n\n"
      "1.00 0 0 0 0 0 0 1\n"
      "1.10 1 0 0 0 0 0.70710678 0.70710678  # half way round\n");
  auto const middle = t.at(FrameIndex{0}, 1050 * kMs);
  ASSERT_TRUE(middle.has_value());
  EXPECT_NEAR(middle->translation().x(), 0.5, 1e-9);
  EXPECT_NEAR(so3_log(middle->rotation()).z(), M_PI / 4, 1e-6);
  EXPECT_EQ(x_at(t, 1000 * kMs), 0.0);
  EXPECT_EQ(x_at(t, 1100 * kMs), 1.0);
}

TEST_F(TrajectoryTest, BeforeAfterAndInGapsItTakesTheNearestWithinTwentyMilliseconds) {
  Trajectory const t = trajectory("1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n");
  EXPECT_TRUE(std::isnan(x_at(t, 979 * kMs)));
  EXPECT_EQ(x_at(t, 980 * kMs), 1.0);
  EXPECT_EQ(x_at(t, 1020 * kMs), 1.0);
  EXPECT_TRUE(std::isnan(x_at(t, 1021 * kMs)));
  EXPECT_TRUE(std::isnan(x_at(t, 1979 * kMs)));
  EXPECT_EQ(x_at(t, 1980 * kMs), 2.0);
  EXPECT_EQ(x_at(t, 2020 * kMs), 2.0);
  EXPECT_TRUE(std::isnan(x_at(t, 2021 * kMs)));
}

TEST_F(TrajectoryTest, TakesPosesByFrameInBothForms) {
  Trajectory const t = trajectory(
      "1 0 0 7 0 1 0 0 0 0 1 0\n"
      "1 0 0 8 0 1 0 0 0 0 1 0 0 0 0 1\n");
  EXPECT_EQ(t.at(FrameIndex{0}, 99)->translation().x(), 7.0);
  EXPECT_EQ(t.at(FrameIndex{1}, 99)->translation().x(), 8.0);
  EXPECT_FALSE(t.at(FrameIndex{2}, 99).has_value());
}

TEST_F(TrajectoryTest, BadTrajectoriesSayWhereAndWhy) {
  EXPECT_EQ(trajectory_error(""), " trajectory has no poses");
  EXPECT_EQ(trajectory_error("# nothing\n"), " trajectory has no poses");
  EXPECT_EQ(trajectory_error("# a\n1 0 0 0 0 0 1\n"),
            "2: needs 8 (stamp, position, quaternion), 12 or 16 numbers, has 7");
  EXPECT_EQ(trajectory_error("1 0 0 0 0 0 0 one\n"), "1: 'one' is no number");
  EXPECT_EQ(trajectory_error("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"), "2: stamp does not rise");
  EXPECT_EQ(trajectory_error("1e30 0 0 0 0 0 0 1\n"), "1: stamp is no time in seconds");
  EXPECT_EQ(trajectory_error("1 0 inf 0 0 0 0 1\n"), "1: pose has a number that is not finite");
  EXPECT_EQ(trajectory_error("1 0 0 0 0 0 0 0\n"), "1: quaternion is not of unit length");
  EXPECT_EQ(trajectory_error("1 0 0 0 0 0 0 1\n1 0 0 0 0 1 0 0 0 0 1 0\n"),
            "2: mixes poses by stamp and poses by frame");
  EXPECT_EQ(trajectory_error("1 0 0 0 0 1 0 0 0 0 2 0\n"),
            "1: the 3x3 part of the pose is not a rotation");
  EXPECT_THROW(Trajectory(folder_ / "none.txt"), InputError);
}

TEST(Stamps, AreTimesThatFitNanoseconds) {
  EXPECT_EQ(stamp_from_seconds(1.5), 1'500'000'000);
  EXPECT_EQ(stamp_from_seconds(-0.001), -1'000'000);
  EXPECT_EQ(stamp_from_seconds(1e10), std::nullopt);
  EXPECT_EQ(stamp_from_seconds(std::nan("")), std::nullopt);
}

}  // namespace
}  // namespace credo
