#include "detector/poses/symmetry_twin.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

Eigen::Quaterniond const kHalfTurn(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitZ()));

struct Look {
  SearchModel model;
  SearchScene scene;
  Se3 truth;

  Look(ObjectModel const& object, double yaw_rad) : model(prepare_model(object)) {
    std::vector<Placed> things = desk_and_floor();
    Se3 const T_world_model = placed_at({0.02, 0.03, 0}, yaw_rad);
    things.push_back({object, T_world_model});
    scene = scene_of(*frame_of(things, before_desk(), {SensorModel::kGaussian}));
    truth = before_desk().inverse() * T_world_model;
  }
  [[nodiscard]] CameraPose the_other_way_round() const {
    return camera_pose(truth * Se3(kHalfTurn, Vector3d::Zero()));
  }
};

class NearlySymmetric : public ::testing::TestWithParam<double> {};

TEST_P(NearlySymmetric, IsTurnedTheWayItIs) {
  Look const look(nearly_symmetric_box(), GetParam());
  for (CameraPose const& told : {look.the_other_way_round(), camera_pose(look.truth)}) {
    Vector6d const error = boxminus(look.truth, se3(best_twin(look.model, look.scene, told)));
    EXPECT_LT(error.head<3>().norm(), 0.002);
    EXPECT_LT(error.tail<3>().norm(), 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Yaws, NearlySymmetric, ::testing::Values(0.3, 1.9, 3.5, 5.1));

void expect_as_it_is(SearchModel const& model, SearchScene const& scene, CameraPose const& pose) {
  CameraPose const best = best_twin(model, scene, pose);
  EXPECT_EQ(best.rotation, pose.rotation);
  EXPECT_EQ(best.translation_m, pose.translation_m);
}

TEST(SymmetryTwin, WhatIsTrulySymmetricStaysAsItIs) {
  Look const look(crate({0.18, 0.10, 0.06}), 0.4);
  expect_as_it_is(look.model, look.scene, camera_pose(look.truth));
  expect_as_it_is(look.model, look.scene, look.the_other_way_round());
}

TEST(SymmetryTwin, WhatHasNoTwinOrIsNotSeenStaysAsItIs) {
  BracketView const view = bracket_on_desk(0.3);
  expect_as_it_is(prepared_bracket(), view.scene, view.truth);
  SearchModel const box = prepare_model(nearly_symmetric_box());
  CameraPose const aside{Eigen::Matrix3f::Identity(), {5.0F, 0.0F, 1.0F}};
  expect_as_it_is(box, view.scene, aside);
}

// A pot that stands on either end as its model says, with a rim on one.
TEST(SymmetryTwin, EndForEndIsTriedToo) {
  Symmetry symmetry;
  symmetry.axis = SymmetryAxis{Vector3d::UnitZ(), {0.0, 0.0, 0.06}, true};
  ObjectModel const pot{
      "pot", std::vector<Solid>{CylinderSolid{0.05, 0.12}, CylinderSolid{0.06, 0.03}}, symmetry};
  Look const look(pot, 0.0);
  CameraPose const upside_down = camera_pose(look.truth * end_for_end(*symmetry.axis));
  CameraPose const best = best_twin(look.model, look.scene, upside_down);
  Vector3d const up = look.truth.rotation() * Vector3d::UnitZ();
  EXPECT_GT(best.rotation.col(2).cast<double>().dot(up), 0.999);
}

}  // namespace
}  // namespace credo::test
