#include "core/prior_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/yaml_file.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kProbability = 0.95;

/// One object of a prior; `pose` comes between its model and its deviations.
std::string object(std::string const& pose = "position: [1, 2, 3]", std::string const& id = "a") {
  return "  - {id: " + id + ", model: box, " + pose +
         ", sigma_position_m: 0.1, sigma_rotation_rad: 0.2}\n";
}

class PriorFileTest : public testing::Test {
protected:
  Prior prior(std::string const& yaml) {
    return prior_of(read_yaml<PriorFile>(path_, yaml), kProbability, path_.string());
  }
  ObjectBelief only(std::string const& object_yaml) {
    Prior const read = prior("objects:\n" + object_yaml);
    EXPECT_THAT(read.objects, SizeIs(1));
    return read.objects.at(0);
  }
  std::string error(std::string const& yaml) {
    return error_in(path_, [&] { (void)prior(yaml); });
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "prior.yaml";
};

/// Equal but for a sign, which changes no rotation.
void expect_rotation(PoseDistribution const& pose, Eigen::Quaterniond const& expected) {
  EXPECT_LT(pose.mean.rotation().angularDistance(expected), 1e-9)
      << pose.mean.rotation().coeffs().transpose();
}

void expect_variances(PoseDistribution const& pose, Vector6d const& expected) {
  EXPECT_LT((pose.covariance - Matrix6d(expected.asDiagonal())).norm(), 1e-12) << pose.covariance;
}

TEST_F(PriorFileTest, KeepsObjectsInTheirOrder) {
  Prior const read = prior("objects:\n" + object("position: [1, 2, 3]", "b") +
                           "  - {id: a, model: models/can.yaml, position: [4, 5, 6], "
                           "sigma_position_m: 1, sigma_rotation_rad: 1}\n");
  EXPECT_EQ(read.frame, PriorFrame::kWorld);
  ASSERT_THAT(read.objects, SizeIs(2));
  EXPECT_EQ(read.objects[0].id, "b");
  EXPECT_EQ(read.objects[0].type, "box");
  EXPECT_EQ(read.objects[0].pose_world.mean.translation(), Vector3d(1, 2, 3));
  EXPECT_EQ(read.objects[1].id, "a");
  EXPECT_EQ(read.objects[1].type, "models/can.yaml");
  EXPECT_EQ(read.objects[1].pose_world.mean.translation(), Vector3d(4, 5, 6));
}

TEST_F(PriorFileTest, AFileMayKnowOfNothing) {
  for (char const* yaml : {"", "objects: []\n", "frame: world\n"}) {
    EXPECT_THAT(prior(yaml).objects, IsEmpty());
  }
}

TEST_F(PriorFileTest, AnObjectIsBelievedWithTheProbabilityGiven) {
  ObjectBelief const believed = only(object());
  EXPECT_NEAR(believed.log_odds, std::log(19.0), 1e-12);
  EXPECT_EQ(believed.evidence, Evidence::kNotSeen);
  EXPECT_FALSE(believed.label.has_value());
  EXPECT_FALSE(believed.last_seen.has_value());
}

TEST_F(PriorFileTest, OrientationsAreQuaternionsXyzw) {
  expect_rotation(
      only(object("position: [0, 0, 0], orientation_xyzw: [0, 0, 0.6, 0.8]")).pose_world,
      Eigen::Quaterniond(0.8, 0, 0, 0.6));
  expect_rotation(only(object("position: [0, 0, 0], orientation_xyzw: [1, 0, 0, 0]")).pose_world,
                  Eigen::Quaterniond(0, 1, 0, 0));
}

TEST_F(PriorFileTest, QuaternionsOffByRoundingAreNormalised) {
  ObjectBelief const believed =
      only(object("position: [0, 0, 0], orientation_xyzw: [0, 0, 0, 1.009]"));
  EXPECT_EQ(believed.pose_world.mean.rotation().norm(), 1.0);
  expect_rotation(believed.pose_world, Eigen::Quaterniond::Identity());
}

// x to y, y to z, z to x. Were it z and then x, x would go to z.
TEST_F(PriorFileTest, OrOrientationsAreTurnsAboutFixedAxes) {
  expect_rotation(only(object("position: [0, 0, 0], rpy_deg: [90, 0, 90]")).pose_world,
                  Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5));
}

TEST_F(PriorFileTest, WithoutAnOrientationThereIsNoTurn) {
  EXPECT_EQ(only(object()).pose_world.mean.rotation().coeffs(),
            Eigen::Quaterniond::Identity().coeffs());
}

TEST_F(PriorFileTest, DeviationsAreSquaredPositionBeforeRotation) {
  ObjectBelief const believed = only(
      "  - {id: a, model: box, position: [0, 0, 0], sigma_position_m: [0.1, 0.2, 0.3], "
      "sigma_rotation_rad: [0.4, 0.5, 0.6]}\n");
  expect_variances(believed.pose_world, Vector6d(0.01, 0.04, 0.09, 0.16, 0.25, 0.36));
}

TEST_F(PriorFileTest, OneDeviationStandsForAllAxes) {
  expect_variances(only(object()).pose_world, Vector6d(0.01, 0.01, 0.01, 0.04, 0.04, 0.04));
}

/// Where the camera stands at the first frame: x of it is y of the world.
Se3 camera() {
  return {Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), {10, 20, 30}};
}

constexpr char const* kTurned =
    "objects:\n  - {id: a, model: box, position: [1, 2, 3], orientation_xyzw: [1, 0, 0, 0], "
    "sigma_position_m: [0.1, 0.2, 0.3], sigma_rotation_rad: [0.4, 0.5, 0.6]}\n";

TEST_F(PriorFileTest, PosesInTheWorldStayWhereverTheCameraIs) {
  BeliefState const belief = prior_belief(prior(kTurned), camera());
  ASSERT_THAT(belief.objects, SizeIs(1));
  EXPECT_EQ(belief.frame, kPriorFrame);
  EXPECT_EQ(belief.objects[0].pose_world.mean.translation(), Vector3d(1, 2, 3));
  expect_rotation(belief.objects[0].pose_world, Eigen::Quaterniond(0, 1, 0, 0));
  expect_variances(belief.objects[0].pose_world, Vector6d(0.01, 0.04, 0.09, 0.16, 0.25, 0.36));
}

TEST_F(PriorFileTest, PosesInTheCameraTurnIntoTheWorldWithTheirCovariances) {
  Prior const told = prior("frame: camera\n" + std::string(kTurned));
  EXPECT_EQ(told.frame, PriorFrame::kCamera);
  EXPECT_EQ(told.objects.at(0).pose_world.mean.translation(), Vector3d(1, 2, 3));
  BeliefState const belief = prior_belief(told, camera());
  ASSERT_THAT(belief.objects, SizeIs(1));
  ObjectBelief const& believed = belief.objects[0];
  EXPECT_EQ(believed.id, "a");
  EXPECT_EQ(believed.log_odds, told.objects[0].log_odds);
  EXPECT_LT((believed.pose_world.mean.translation() - Vector3d(8, 21, 33)).norm(), 1e-12);
  expect_rotation(believed.pose_world, Eigen::Quaterniond(0, std::sqrt(0.5), std::sqrt(0.5), 0));
  expect_variances(believed.pose_world, Vector6d(0.04, 0.01, 0.09, 0.25, 0.16, 0.36));
}

struct Golden {
  std::string yaml;
  std::string error;
};

class PriorFileError : public PriorFileTest, public testing::WithParamInterface<Golden> {};

TEST_P(PriorFileError, IsGolden) {
  EXPECT_EQ(error(GetParam().yaml), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Incomplete, PriorFileError,
    testing::Values(
        Golden{"objects:\n" + object() + "  - {model: box}\n", "FILE: objects[1]: id is missing"},
        Golden{"objects:\n  - {id: \"\", model: box}\n", "FILE: objects[0]: id is missing"},
        Golden{"objects:\n  -\n", "FILE: objects[0]: id is missing"},
        Golden{"objects: [{id: a}]\n", "FILE: objects[0] (a): model is missing"},
        Golden{"objects: [{id: a, model: box}]\n", "FILE: objects[0] (a): position is missing"},
        Golden{"objects: [{id: a, model: box, position: [1, 2, 3], sigma_rotation_rad: 1}]\n",
               "FILE: objects[0] (a): sigma_position_m is missing"},
        Golden{"objects: [{id: a, model: box, position: [1, 2, 3], sigma_position_m: 1}]\n",
               "FILE: objects[0] (a): sigma_rotation_rad is missing"}));

constexpr char const* kUnitLength = "FILE: objects[0] (a): orientation_xyzw must be of unit length";

INSTANTIATE_TEST_SUITE_P(
    Contradictory, PriorFileError,
    testing::Values(
        Golden{
            "objects:\n" +
                object("position: [0, 0, 0], orientation_xyzw: [0, 0, 0, 1], rpy_deg: [0, 0, 0]"),
            "FILE: objects[0] (a): give orientation_xyzw or rpy_deg, not both"},
        Golden{"objects:\n" + object("position: [0, 0, 0], orientation_xyzw: [0, 0, 0, 0]"),
               kUnitLength},
        Golden{"objects:\n" + object("position: [0, 0, 0], orientation_xyzw: [0, 0, 0, 0.98]"),
               kUnitLength},
        Golden{"objects:\n" + object("position: [0, 0, 0], orientation_xyzw: [1, 1, 0, 0]"),
               kUnitLength},
        Golden{"objects:\n" + object() + object("position: [0, 0, 0]", "b") + object(),
               "FILE: objects[2] (a): this id is used twice"}));

constexpr char const* kNoSigma =
    "objects:\n  - {id: a, model: box, position: [1, 2, 3], sigma_rotation_rad: 0.1,\n     ";

INSTANTIATE_TEST_SUITE_P(
    CovariancesThatAreNotPositive, PriorFileError,
    testing::Values(
        Golden{std::string(kNoSigma) + "sigma_position_m: 0}\n",
               "FILE:3:6: objects[0].sigma_position_m = 0: must be in [0.00001, 1000] m"},
        Golden{std::string(kNoSigma) + "sigma_position_m: -0.1}\n",
               "FILE:3:6: objects[0].sigma_position_m = -0.1: must be in [0.00001, 1000] m"},
        Golden{std::string(kNoSigma) + "sigma_position_m: [0.1, 0, 0.1]}\n",
               "FILE:3:6: objects[0].sigma_position_m[1] = 0: must be in [0.00001, 1000] m"},
        Golden{std::string(kNoSigma) + "sigma_position_m: nan}\n",
               "FILE:3:6: objects[0].sigma_position_m = nan: must be in [0.00001, 1000] m"},
        Golden{std::string(kNoSigma) + "sigma_position_m: .nan}\n",
               "FILE:3:6: objects[0].sigma_position_m = .nan: must be a number"},
        Golden{std::string(kNoSigma) + "sigma_position_m: [0.1, 0.1]}\n",
               "FILE:3:6: objects[0].sigma_position_m: must be one number or a list of 3"},
        Golden{"objects:\n  - {id: a, model: box, sigma_rotation_rad: [0.1, 0.1, -0.1]}\n",
               "FILE:2:25: objects[0].sigma_rotation_rad[2] = -0.1: must be in [0.00001, 100] "
               "rad"}));

INSTANTIATE_TEST_SUITE_P(
    ValuesAndKeys, PriorFileError,
    testing::Values(
        Golden{"frame: robot\n", "FILE:1:1: frame = robot: must be one of world, camera"},
        Golden{"objects: {id: a}\n", "FILE:1:1: objects: must be a list"},
        Golden{"objects:\n  - {position: [1, 2]}\n",
               "FILE:2:6: objects[0].position: must be a list of 3 numbers"},
        Golden{"objects:\n  - {position: [1, 2, inf]}\n",
               "FILE:2:6: objects[0].position[2] = inf: must be in [-10000, 10000] m"},
        Golden{"objects:\n  - {orientation_xyzw: [0, 0, 1]}\n",
               "FILE:2:6: objects[0].orientation_xyzw: must be a list of 4 numbers"},
        Golden{"objects:\n  - {orientation_xyzw: [0, 0, nan, 1]}\n",
               "FILE:2:6: objects[0].orientation_xyzw[2] = nan: must be in [-1.1, 1.1]"},
        Golden{"objects:\n  - {rpy_deg: [0, 0, 361]}\n",
               "FILE:2:6: objects[0].rpy_deg[2] = 361: must be in [-360, 360] deg"},
        Golden{"objects:\n  - {id: a}\n  - {sigma_position: 1}\n",
               "FILE:3:6: unknown key objects[1].sigma_position (did you mean "
               "sigma_position_m?)"}));

TEST_F(PriorFileTest, NoMoreObjectsThanHaveALabel) {
  PriorFile file;
  for (int i = 0; i < 1000; ++i) {
    std::string const id = "object_" + std::to_string(i);
    file.objects.push_back({id, "box", {0, 0, 0}, {}, {}, {1, 1, 1}, {1, 1, 1}});
  }
  EXPECT_THAT(prior_of(file, kProbability, "FILE").objects, SizeIs(1000));
  file.objects.push_back(file.objects.back());
  EXPECT_EQ(error_in(path_, [&] { (void)prior_of(file, kProbability, "FILE"); }),
            "FILE: 1001 objects are more than 1000");
}

}  // namespace
}  // namespace credo::test
