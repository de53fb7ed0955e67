#include "sim/resting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/mesh_making.hpp"

namespace credo::test {
namespace {

TEST(Resting, TheCentreOfMassOfAShiftedBox) {
  Eigen::Vector3d const place(0.3, -0.2, 0.5);
  TriangleMesh const box =
      moved(block({0.1, 0.2, 0.3}), Se3(Eigen::Quaterniond::Identity(), place));
  EXPECT_LT((centre_of_mass(box) - place).norm(), 1e-6);
  // A cone's is a quarter of its height up.
  TriangleMesh const cone = revolved({{0, 0}, {0.1, 0}, {0, 0.4}});
  EXPECT_LT((centre_of_mass(cone) - Eigen::Vector3d(0, 0, 0.1)).norm(), 1e-6);
}

TEST(Resting, ABoxRestsOnItsSixSides) {
  std::vector<Rest> const rests = rests_of(block({0.1, 0.2, 0.3}));
  ASSERT_EQ(rests.size(), 6U);
  double sum = 0.0;
  for (Rest const& rest : rests) {
    sum += rest.share;
    // One of the box's axes is upright.
    Eigen::Vector3d const up = rest.turn.conjugate() * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR(up.cwiseAbs().maxCoeff(), 1.0, 1e-4);
    // The widest sides are 0.2 x 0.3 of 0.22 square metres in all.
    double const widest = std::abs(up.x()) > 0.9 ? 0.06 : std::abs(up.y()) > 0.9 ? 0.03 : 0.02;
    EXPECT_NEAR(rest.share, widest / 0.22, 1e-3);
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(Resting, ATallLeaningPrismFallsOver) {
  // Slanted so far that its middle is beyond its foot.
  TriangleMesh slanted = block({0.1, 0.1, 0.4});
  for (Eigen::Vector3f& vertex : slanted.vertices) {
    vertex.x() += 0.5F * vertex.z();
  }
  for (Rest const& rest : rests_of(slanted)) {
    Eigen::Vector3d const down = rest.turn.conjugate() * -Eigen::Vector3d::UnitZ();
    EXPECT_LT(std::abs(down.z()), 0.99) << "on its foot";
  }
}

TEST(Resting, AThinRodDoesNotStandOnItsEnd) {
  // Half its width over half its height: 0.04, then 0.13.
  EXPECT_EQ(rests_of(block({0.012, 0.012, 0.3})).size(), 4U);
  EXPECT_EQ(rests_of(block({0.04, 0.04, 0.3})).size(), 6U);
}

TEST(Resting, WhatStandsOnASmallKnobFallsThoughItsRimIsNear) {
  // A foot of 8 mm, 4 mm below a wide base: the base does not touch the table.
  TriangleMesh const knobbed =
      joined({block({0.1, 0.1, 0.1}), moved(block({0.008, 0.008, 0.02}),
                                            Se3(Eigen::Quaterniond::Identity(), {0, 0, -0.044}))});
  for (Rest const& rest : rests_of(knobbed)) {
    Eigen::Vector3d const down = rest.turn.conjugate() * -Eigen::Vector3d::UnitZ();
    EXPECT_GT(down.z(), -0.999) << "on its knob";
  }
}

}  // namespace
}  // namespace credo::test
