#include "sim/household.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <variant>

#include "geometry/shapes/mesh_edges.hpp"
#include "geometry/shapes/object_shape.hpp"
#include "geometry/shapes/surface_points.hpp"

namespace credo::test {
namespace {

TEST(Household, TwentySevenClosedMeshesOfNamesOfTheirOwn) {
  std::vector<ObjectModel> const models = household_models();
  ASSERT_EQ(models.size(), 27U);
  std::set<std::string> names;
  for (ObjectModel const& model : models) {
    names.insert(model.name);
    EXPECT_TRUE(is_closed(edges_of(std::get<TriangleMesh>(model.shape)))) << model.name;
    Eigen::AlignedBox3d const box = ObjectShape(model).bounds();
    EXPECT_LT(box.center().norm(), 1e-6) << model.name;
    EXPECT_GT(box.sizes().maxCoeff(), 0.06) << model.name;
    EXPECT_LT(box.sizes().maxCoeff(), 0.35) << model.name;
  }
  EXPECT_EQ(names.size(), 27U);
}

/// How far points of the surface come to lie from it when the model is turned.
double off_surface_m(ObjectModel const& model, Eigen::Quaterniond const& turn) {
  ObjectShape const shape(model);
  double sum_m = 0.0;
  std::vector<Eigen::Vector3d> const points = surface_points(model, 0.01);
  for (Eigen::Vector3d const& point : points) {
    sum_m += std::abs(shape.distance_to(turn * point).distance_m);
  }
  return sum_m / static_cast<double>(points.size());
}

TEST(Household, SymmetriesAreThoseOfTheShapes) {
  for (ObjectModel const& model : household_models()) {
    for (Eigen::Quaterniond const& turn : model.symmetry.rotations) {
      EXPECT_LT(off_surface_m(model, turn), 1e-4) << model.name;
    }
    Eigen::Quaterniond const third(Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitZ()));
    Eigen::Quaterniond const half(Eigen::AngleAxisd(3.14159265, Eigen::Vector3d::UnitZ()));
    if (model.symmetry.axis && model.symmetry.axis->both_ways) {
      EXPECT_LT(off_surface_m(model, end_for_end(*model.symmetry.axis).rotation()), 1e-3)
          << model.name;
    }
    if (model.symmetry.axis) {
      // The turn about the axis, to the size of its sides.
      EXPECT_LT(off_surface_m(model, third), 3e-4) << model.name;
    } else {
      EXPECT_GT(off_surface_m(model, third), 1e-3) << model.name;
    }
    if (!model.symmetry.axis && model.symmetry.rotations.empty()) {
      EXPECT_GT(off_surface_m(model, half), 1e-3) << model.name;
    }
  }
}

}  // namespace
}  // namespace credo::test
