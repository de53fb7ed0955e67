#include "detector/poses/pose_distance.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  CameraPose pose() {
    CameraPose pose;
    pose.rotation = Eigen::AngleAxisf(3.0F * number_(engine_), vector().normalized()).matrix();
    pose.translation_m = 0.1F * vector() + Vector3f(0, 0, 1);
    return pose;
  }
  Vector3f vector() { return {number_(engine_), number_(engine_), number_(engine_)}; }

private:
  std::mt19937 engine_;
  std::normal_distribution<float> number_;
};

/// Only what the distance needs.
SearchModel bare_model(Symmetry symmetry = {}) {
  SearchModel model;
  model.diameter_m = 0.4F;
  model.centre_model = {0.01F, -0.02F, 0.15F};
  model.symmetry = std::move(symmetry);
  return model;
}

Symmetry axis_symmetry() {
  Symmetry symmetry;
  symmetry.axis = SymmetryAxis{Eigen::Vector3d(1, 2, 2).normalized(), {0.02, 0.01, -0.03}};
  return symmetry;
}
/// The quarter turns of a square box about its own centre line.
Symmetry quarter_turns() {
  Symmetry symmetry;
  for (int quarter = 1; quarter < 4; ++quarter) {
    symmetry.rotations.emplace_back(
        Eigen::AngleAxisd(quarter * std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  }
  return symmetry;
}

float literal(SearchModel const& model, CameraPose const& a, CameraPose const& b) {
  return (a * model.centre_model - b * model.centre_model).norm() +
         0.35F * model.diameter_m * static_cast<float>(angle_between(a, b));
}

/// `pose` after a turn of the model about a line in its frame.
CameraPose turned(CameraPose const& pose, Eigen::Matrix3f const& turn, Vector3f const& on_line) {
  return {pose.rotation * turn, pose * (on_line - turn * on_line)};
}

TEST(PoseDistance, IsShiftAndTurn) {
  Random random(1);
  SearchModel const model = bare_model();
  PoseDistance const distance(model);
  for (int i = 0; i < 200; ++i) {
    CameraPose const a = random.pose();
    CameraPose const b = random.pose();
    EXPECT_NEAR(distance(a, b), literal(model, a, b), 2e-4F);
    EXPECT_NEAR(distance(a, a), 0.0F, 2e-4F);
  }
}

TEST(PoseDistance, AShiftCountsAsItIs) {
  PoseDistance const distance(bare_model());
  CameraPose const a = Random(2).pose();
  CameraPose b = a;
  b.translation_m += Vector3f(0.03F, 0.0F, -0.04F);
  EXPECT_NEAR(distance(a, b), 0.05F, 2e-4F);
}

TEST(PoseDistance, TurnsAboutTheAxisAreNone) {
  Random random(3);
  SearchModel const model = bare_model(axis_symmetry());
  PoseDistance const distance(model);
  Vector3f const axis = model.symmetry.axis->direction.cast<float>();
  Vector3f const on_axis = model.symmetry.axis->point_m.cast<float>();
  for (int i = 0; i < 100; ++i) {
    CameraPose const pose = random.pose();
    Eigen::Matrix3f const turn = Eigen::AngleAxisf(0.1F * static_cast<float>(i), axis).matrix();
    EXPECT_NEAR(distance(pose, turned(pose, turn, on_axis)), 0.0F, 5e-4F);
  }
}

/// Least over many turns about the axis.
float least_over_turns(SearchModel const& model, CameraPose const& a, CameraPose const& b) {
  constexpr int kTurns = 2000;
  Vector3f const axis = model.symmetry.axis->direction.cast<float>();
  Vector3f const point = model.symmetry.axis->point_m.cast<float>();
  SearchModel about_axis = model;
  // What the turns leave where it is.
  about_axis.centre_model = point + axis * axis.dot(model.centre_model - point);
  float least = std::numeric_limits<float>::infinity();
  for (int k = 0; k < kTurns; ++k) {
    float const angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(k) / kTurns;
    CameraPose const same = turned(b, Eigen::AngleAxisf(angle, axis).matrix(), point);
    least = std::min(least, literal(about_axis, a, same));
  }
  return least;
}

TEST(PoseDistance, AboutAnAxisIsTheLeastOverAllTurns) {
  Random random(4);
  SearchModel const model = bare_model(axis_symmetry());
  PoseDistance const distance(model);
  for (int i = 0; i < 20; ++i) {
    CameraPose const a = random.pose();
    CameraPose const b = random.pose();
    EXPECT_NEAR(distance(a, b), least_over_turns(model, a, b), 1e-3F);
  }
}

TEST(PoseDistance, BothWaysIsTheLeastOverTheEndsToo) {
  Random random(6);
  Symmetry symmetry = axis_symmetry();
  symmetry.axis->both_ways = true;
  SearchModel const model = bare_model(symmetry);
  PoseDistance const distance(model);
  Se3 const around = end_for_end(*symmetry.axis);
  int turned_is_nearer = 0;
  for (int i = 0; i < 20; ++i) {
    CameraPose const a = random.pose();
    CameraPose const b = random.pose();
    float const as_it_is = least_over_turns(model, a, b);
    Vector3f const axis = symmetry.axis->direction.cast<float>();
    Vector3f const point = symmetry.axis->point_m.cast<float>();
    Vector3f const on_axis = point + axis * axis.dot(model.centre_model - point);
    float const shift = (a * on_axis - b * (2.0F * point - on_axis)).norm();
    float const cosine = (a.rotation * axis).dot(-(b.rotation * axis));
    float const turned_m =
        shift + 0.35F * model.diameter_m * std::acos(std::clamp(cosine, -1.0F, 1.0F));
    EXPECT_NEAR(distance(a, b), std::min(as_it_is, turned_m), 1e-3F);
    turned_is_nearer += turned_m < as_it_is ? 1 : 0;
    CameraPose const same{b.rotation * around.rotation().toRotationMatrix().cast<float>(),
                          b * around.translation().cast<float>()};
    EXPECT_NEAR(distance(b, same), 0.0F, 2e-3F) << "the other way round";
  }
  EXPECT_GT(turned_is_nearer, 3);
}

TEST(PoseDistance, IsTheLeastOverTheSymmetriesRotations) {
  Random random(5);
  SearchModel const model = bare_model(quarter_turns());
  PoseDistance const distance(model);
  for (int i = 0; i < 100; ++i) {
    CameraPose const a = random.pose();
    CameraPose const b = random.pose();
    float least = literal(model, a, b);
    for (Eigen::Quaterniond const& rotation : model.symmetry.rotations) {
      Eigen::Matrix3f const turn = rotation.toRotationMatrix().cast<float>();
      least = std::min(least, literal(model, a, turned(b, turn, Vector3f::Zero())));
    }
    EXPECT_NEAR(distance(a, b), least, 2e-4F);
  }
}

class AnySymmetry : public ::testing::TestWithParam<int> {
protected:
  static SearchModel model() {
    Symmetry const symmetry = GetParam() == 0   ? Symmetry{}
                              : GetParam() == 1 ? axis_symmetry()
                                                : quarter_turns();
    SearchModel model = bare_model(symmetry);
    if (GetParam() == 2) {
      // A symmetric body has its centre on the line that it is turned about.
      model.centre_model = {0.0F, 0.0F, 0.15F};
    }
    return model;
  }
};

TEST_P(AnySymmetry, IsADistance) {
  Random random(6);
  PoseDistance const distance(model());
  for (int i = 0; i < 300; ++i) {
    CameraPose const a = random.pose();
    CameraPose const b = random.pose();
    CameraPose const c = random.pose();
    EXPECT_NEAR(distance(a, b), distance(b, a), 5e-4F);
    EXPECT_LE(distance(a, c), distance(a, b) + distance(b, c) + 1e-3F);
    EXPECT_GE(distance(a, b), 0.0F);
  }
}

TEST_P(AnySymmetry, StaysWhenTheCameraMoves) {
  Random random(7);
  PoseDistance const distance(model());
  for (int i = 0; i < 100; ++i) {
    CameraPose const a = random.pose();
    CameraPose const b = random.pose();
    CameraPose const moved = random.pose();
    auto const after = [&](CameraPose const& pose) {
      return CameraPose{moved.rotation * pose.rotation, moved * pose.translation_m};
    };
    EXPECT_NEAR(distance(after(a), after(b)), distance(a, b), 5e-4F);
  }
}

INSTANTIATE_TEST_SUITE_P(Symmetries, AnySymmetry, ::testing::Values(0, 1, 2));

}  // namespace
}  // namespace credo::test
