#include "eval/true_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/solid.hpp"
#include "geometry/shapes/surface_points.hpp"

namespace credo::test {
namespace {

Se3 moved(Eigen::Vector3d const& by_m) {
  return {Eigen::Quaterniond::Identity(), by_m};
}
Se3 turned(double angle_rad, Eigen::Vector3d const& axis) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis)), Eigen::Vector3d::Zero()};
}

TEST(TrueModel, DiameterIsTheLongestWayThrough) {
  ObjectModel const box{"box", std::vector<Solid>{box_on_base({0.3, 0.4, 1.2})}, {}};
  EXPECT_NEAR(TrueModel(box).diameter_m(), 1.3, 1e-9);
  ObjectModel const can{"can", std::vector<Solid>{CylinderSolid{0.3, 0.8}}, {}};
  EXPECT_NEAR(TrueModel(can).diameter_m(), 1.0, 0.01);
  ObjectModel const ball{"ball", std::vector<Solid>{SphereSolid{0.5}}, {}};
  EXPECT_NEAR(TrueModel(ball).diameter_m(), 1.0, 0.01);
}

TEST(TrueModel, ErrorsAreLeastOverTheSymmetry) {
  ObjectModel box{"box", std::vector<Solid>{box_on_base({0.3, 0.4, 0.5})}, {}};
  Se3 const half = turned(std::numbers::pi, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(TrueModel(box).error(half, Se3{}).rotation_rad, std::numbers::pi, 1e-9);
  box.symmetry.rotations = {half.rotation()};
  EXPECT_NEAR(TrueModel(box).error(half, Se3{}).rotation_rad, 0.0, 1e-9);
  double const a_little_more = std::numbers::pi + 0.1;
  EXPECT_NEAR(
      TrueModel(box).error(turned(a_little_more, Eigen::Vector3d::UnitZ()), Se3{}).rotation_rad,
      0.1, 1e-9);
}

TEST(TrueModel, AboutAnAxisOnlyItsTiltAndItsPlaceCount) {
  ObjectModel can{"can", std::vector<Solid>{CylinderSolid{0.1, 0.3}}, {}};
  can.symmetry.axis = SymmetryAxis{Eigen::Vector3d::UnitZ(), {0.5, 0, 0}};
  TrueModel const model(can);
  TrueModel::PoseError const turn = model.error(turned(1.0, Eigen::Vector3d::UnitZ()), Se3{});
  EXPECT_NEAR(turn.rotation_rad, 0.0, 1e-12);
  EXPECT_NEAR(turn.translation_m, 2.0 * 0.5 * std::sin(0.5), 1e-12) << "the axis went along";
  EXPECT_NEAR(model.error(turned(0.2, Eigen::Vector3d::UnitX()), Se3{}).rotation_rad, 0.2, 1e-9);
}

TEST(TrueModel, BothWaysTheEndsAreAlike) {
  ObjectModel can{"can", std::vector<Solid>{CylinderSolid{0.1, 0.3}}, {}};
  can.symmetry.axis = SymmetryAxis{Eigen::Vector3d::UnitZ(), {0, 0, 0.15}, true};
  TrueModel const model(can);
  Se3 const over = end_for_end(*can.symmetry.axis);
  EXPECT_NEAR(model.error(over, Se3{}).rotation_rad, 0.0, 1e-9);
  EXPECT_NEAR(model.error(over, Se3{}).translation_m, 0.0, 1e-9);
  EXPECT_NEAR(model.error(over * turned(0.2, Eigen::Vector3d::UnitX()), Se3{}).rotation_rad, 0.2,
              1e-9);
  can.symmetry.axis->both_ways = false;
  EXPECT_NEAR(TrueModel(can).error(over, Se3{}).rotation_rad, std::numbers::pi, 1e-9);
}

TEST(TrueModel, AddSIsTheMeanDistanceOfTheSurfaces) {
  ObjectModel const ball{"ball", std::vector<Solid>{SphereSolid{0.1}}, {}};
  TrueModel const model(ball);
  EXPECT_NEAR(model.add_s_m(Se3{}, Se3{}), 0.0, 1e-9);
  // A sphere shifted by d: the mean of |cos| over it is a half, to first order.
  EXPECT_NEAR(model.add_s_m(moved({0, 0, 0.004}), Se3{}), 0.002, 2e-4);
  EXPECT_NEAR(model.add_s_m(turned(2.0, {0, 0, 1}), Se3{}), 0.0, 1e-9) << "no sign of the turn";
  EXPECT_NEAR(model.centre_distance_m(moved({0, 0, 0.3}), Se3{}), 0.3, 1e-12);
}

/// ADD-S by its definition: each point's nearest among many.
double literal_add_s_m(std::vector<Eigen::Vector3d> const& points, Se3 const& believed,
                       Se3 const& truth) {
  double sum = 0.0;
  for (Eigen::Vector3d const& point : points) {
    double least = 1e9;
    for (Eigen::Vector3d const& other : points) {
      least = std::min(least, (believed * point - truth * other).norm());
    }
    sum += least;
  }
  return sum / static_cast<double>(points.size());
}

TEST(TrueModel, AddSIsThatOfDensePoints) {
  ObjectModel const box{"box", std::vector<Solid>{box_on_base({0.06, 0.1, 0.14})}, {}};
  std::vector<Eigen::Vector3d> const points = surface_points(box, 0.0025);
  TrueModel const model(box);
  for (Se3 const& error : {moved({0.01, -0.02, 0.015}), turned(0.4, {0, 0.6, 0.8}),
                           moved({0, 0, 0.03}) * turned(2.0, {1, 0, 0})}) {
    double const literal = literal_add_s_m(points, error, Se3{});
    EXPECT_NEAR(model.add_s_m(error, Se3{}), literal, 0.05 * literal + 5e-4);
  }
}

TEST(TrueModel, AddIsTheMeanWayOfThePoints) {
  ObjectModel const box{"box", std::vector<Solid>{box_on_base({0.3, 0.4, 0.5})}, {}};
  TrueModel const model(box);
  EXPECT_NEAR(model.add_m(moved({0.03, 0.04, 0}), Se3{}), 0.05, 1e-12);
  // Half a turn takes each point to twice its distance from the axis: a box keeps its surface.
  double const half = model.add_m(turned(std::numbers::pi, Eigen::Vector3d::UnitZ()), Se3{});
  EXPECT_GT(half, 0.2);
  EXPECT_LT(half, 0.5);
  EXPECT_NEAR(model.add_s_m(turned(std::numbers::pi, Eigen::Vector3d::UnitZ()), Se3{}), 0.0, 1e-9);
}

}  // namespace
}  // namespace credo::test
