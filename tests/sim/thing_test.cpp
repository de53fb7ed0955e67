#include "sim/thing.hpp"

#include <gtest/gtest.h>

#include "geometry/shapes/solid.hpp"
#include "sim/scenes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

TEST(Thing, ATableIsATopAndFourLegs) {
  SceneThing const table = thing("table", SceneShape::kTable, {0.8, 1.2, 0.7, 0.04, 0.06});
  std::vector<Solid> const solids = solids_of(table);
  ASSERT_EQ(solids.size(), 5U);
  Eigen::AlignedBox3d all;
  for (Solid const& solid : solids) {
    all.extend(bounds_of(solid));
  }
  EXPECT_NEAR((all.min() - Vector3d(-0.4, -0.6, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((all.max() - Vector3d(0.4, 0.6, 0.7)).norm(), 0, 1e-12);
  EXPECT_NEAR(bounds_of(solids[0]).min().z(), 0.66, 1e-12);
  for (std::size_t leg = 1; leg < 5; ++leg) {
    EXPECT_NEAR(bounds_of(solids[leg]).sizes().x(), 0.06, 1e-12);
    EXPECT_NEAR(bounds_of(solids[leg]).max().z(), 0.66, 1e-12);
  }
}

TEST(Thing, PosesTurnAboutTheFixedAxesInOrder) {
  SceneThing turned = thing("box", SceneShape::kBox, {1, 1, 1}, {1, 2, 3});
  turned.rpy_deg = {90, 0, 90};
  // First about x: y to z, z to -y; then about z: x to y, y to -x.
  Se3 const T = pose_of(turned);
  EXPECT_NEAR((T * Vector3d(1, 0, 0) - Vector3d(1, 3, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR((T * Vector3d(0, 1, 0) - Vector3d(1, 2, 4)).norm(), 0, 1e-12);
  EXPECT_NEAR((T * Vector3d(0, 0, 1) - Vector3d(2, 2, 3)).norm(), 0, 1e-12);
}

TEST(Thing, ATypeIsTheNameUnlessGiven) {
  EXPECT_EQ(type_of(object("mug_1", "mug", SceneShape::kSphere, {1}, {0, 0, 0})), "mug");
  EXPECT_EQ(type_of(object("mug", "", SceneShape::kSphere, {1}, {0, 0, 0})), "mug");
}

}  // namespace
}  // namespace credo::test
