#include "sim/height_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sim/mesh_making.hpp"

namespace credo::test {
namespace {

TEST(HeightField, AFootprintHasTheBodysUnderAndUpperSide) {
  Footprint const box = footprint_of(block({0.1, 0.06, 0.04}));
  Pixel const middle{static_cast<int>(std::lround(box.origin_m.x() / kHeightCell_m)),
                     static_cast<int>(std::lround(box.origin_m.y() / kHeightCell_m))};
  EXPECT_NEAR(box.low_m[middle], 0.0, 1e-6);
  EXPECT_NEAR(box.high_m[middle], 0.04, 1e-6);
  EXPECT_NEAR(box.origin_m.z(), 0.02, 1e-6);
  EXPECT_TRUE(std::isnan(box.high_m[Pixel{0, 0}]));
  int covered = 0;
  for (float const high : box.high_m) {
    covered += std::isnan(high) ? 0 : 1;
  }
  EXPECT_NEAR(covered * kHeightCell_m * kHeightCell_m, 0.1 * 0.06, 0.0005);
}

TEST(HeightField, BodiesComeDownOnEachOther) {
  HeightField field(200, 200);
  Footprint const box = footprint_of(block({0.1, 0.1, 0.04}));
  auto const first = field.drop(box, {50, 50});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->height_m, 0.0);
  field.add(box, *first);
  EXPECT_NEAR(field.drop(box, {70, 60})->height_m, 0.04, 1e-6);
  EXPECT_EQ(field.drop(box, {110, 50})->height_m, 0.0) << "beside it";
  EXPECT_FALSE(field.drop(box, {-1, 50})) << "over the edge";
  EXPECT_FALSE(field.drop(box, {190, 50}));
}

TEST(HeightField, ContactsAreWhereBodiesTouch) {
  HeightField field(200, 200);
  Footprint const box = footprint_of(block({0.1, 0.1, 0.04}));
  field.add(box, *field.drop(box, {50, 50}));
  Drop const upper = field.drop(box, {80, 50}).value();
  auto const contacts = field.contacts(box, upper, 0.001);
  ASSERT_FALSE(contacts.empty());
  Eigen::AlignedBox2d area;
  for (Eigen::Vector2d const& contact : contacts) {
    area.extend(contact);
  }
  // The second box reaches over the first by 20 of its 50 cells.
  EXPECT_NEAR(area.sizes().x(), 20 * kHeightCell_m, 0.005);
  EXPECT_NEAR(area.sizes().y(), 0.1, 0.005);
}

}  // namespace
}  // namespace credo::test
