// Priors and models of known objects, printed and read again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/model_file.hpp"
#include "core/prior_file.hpp"
#include "support/yaml_file.hpp"

namespace credo::test {
namespace {

using testing::SizeIs;

void expect_same(ModelFile const& a, ModelFile const& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.box_m, b.box_m);
  EXPECT_EQ(a.cylinder_radius_m, b.cylinder_radius_m);
  EXPECT_EQ(a.cylinder_height_m, b.cylinder_height_m);
  EXPECT_EQ(a.table_top_m, b.table_top_m);
  EXPECT_EQ(a.table_thickness_m, b.table_thickness_m);
  EXPECT_EQ(a.table_height_m, b.table_height_m);
  EXPECT_EQ(a.table_leg_m, b.table_leg_m);
  EXPECT_EQ(a.mesh, b.mesh);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.one_sided, b.one_sided);
  EXPECT_EQ(a.symmetry.form, b.symmetry.form);
  EXPECT_EQ(a.symmetry.word, b.symmetry.word);
  EXPECT_EQ(a.symmetry.axis, b.symmetry.axis);
  EXPECT_EQ(a.symmetry.point_m, b.symmetry.point_m);
  ASSERT_EQ(a.symmetry.turns.size(), b.symmetry.turns.size());
  for (std::size_t i = 0; i < a.symmetry.turns.size(); ++i) {
    EXPECT_EQ(a.symmetry.turns[i].rpy_deg, b.symmetry.turns[i].rpy_deg);
  }
}

void expect_same(PriorEntry const& a, PriorEntry const& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.orientation_xyzw, b.orientation_xyzw);
  EXPECT_EQ(a.rpy_deg, b.rpy_deg);
  EXPECT_EQ(a.sigma_position_m, b.sigma_position_m);
  EXPECT_EQ(a.sigma_rotation_rad, b.sigma_rotation_rad);
}

template <typename T>
std::string printed(T file) {
  return config_yaml(fields(file));
}

class ObjectFiles : public testing::Test {
protected:
  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "a.yaml";
};

class ModelFiles : public ObjectFiles, public testing::WithParamInterface<char const*> {};

TEST_P(ModelFiles, ReadBackAsPrinted) {
  auto const file = read_yaml<ModelFile>(path_, GetParam());
  expect_same(read_yaml<ModelFile>(path_, printed(file)), file);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ModelFiles,
    testing::Values("", "name: off\n", "primitive: {box: [0.1, 0.33333333333333331, 1e-4]}\n",
                    "name: \"a: 'b'\"\nprimitive: {cylinder: {radius: 0.045, height: 0.26}}\n",
                    "primitive: {cylinder: {radius: 0.045}}\n",
                    "primitive: {table: {top: [0.8, 1.2], thickness: 0.04, height: 0.7, leg: 0.1}}",
                    "mesh: \"a #1.ply\"\nunit: mm\n", "mesh: a.ply\none_sided: true\n"));

INSTANTIATE_TEST_SUITE_P(Symmetries, ModelFiles,
                         testing::Values("symmetry: own\n", "symmetry: none\n",
                                         "symmetry: {axis: [0, 1e-3, -1]}\n",
                                         "symmetry: {axis: [0, 0, 1], point: [0.1, 0.2, -0.3]}\n",
                                         "symmetry: {point: [0.1, 0.2, -0.3]}\n", "symmetry: []\n",
                                         "symmetry: [[0, 0, 180], {rpy_deg: [0.1, -90, 45]}]\n",
                                         "symmetry: [[0, 0, 180], {}]\n"));

TEST_F(ObjectFiles, PriorsReadBackAsPrinted) {
  auto const file = read_yaml<PriorFile>(path_, R"(
frame: camera
objects:
  - {id: a, model: box, position: [1, 0.1, -3], sigma_position_m: 0.3, sigma_rotation_rad: 0.1}
  - {id: b, model: models/b.yaml, position: [0, 0, 0], orientation_xyzw: [0, 0.6, 0, -0.8],
     sigma_position_m: [0.1, 0.2, 0.3], sigma_rotation_rad: 1e-5}
  - {id: "#3", model: box, position: [0, 0, 0], rpy_deg: [0, 12.5, 90]}
  - {}
)");
  auto const back = read_yaml<PriorFile>(path_, printed(file));
  EXPECT_EQ(back.frame, PriorFrame::kCamera);
  ASSERT_THAT(file.objects, SizeIs(4));
  ASSERT_THAT(back.objects, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) {
    expect_same(back.objects[i], file.objects[i]);
  }
  EXPECT_THAT(read_yaml<PriorFile>(path_, printed(PriorFile{})).objects, SizeIs(0));
}

// Printed as nothing, it would be refused when read.
TEST_F(ObjectFiles, WhatIsNotGivenIsNotPrinted) {
  EXPECT_EQ(printed(read_yaml<ModelFile>(path_, "name: can\nprimitive: {cylinder: {radius: 1}}")),
            R"(name: "can"  # what objects and detections call it; the file's name if empty
# a shape that stands on the centre of its base, z up
primitive:
  # upright
  cylinder:
    radius: 1  # radius ([0.0001, 100] m)
  # a top on four legs
  table:
mesh: ""  # a mesh's file, beside this one; it keeps its own frame
unit: m  # of the mesh's numbers (m, mm)
one_sided: false  # an open mesh whose triangles show their outside alone: what is behind was never seen
symmetry: own  # own, none, {axis, point, both_ways}, or the list of all turns that change nothing (own, none)
)");
}

}  // namespace
}  // namespace credo::test
