#include "core/model_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "support/yaml_file.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;
using testing::IsEmpty;
using testing::SizeIs;

TriangleMesh one_triangle() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
}

class ModelFileTest : public testing::Test {
protected:
  /// The model of a file that says this; where it names a mesh, that is one triangle.
  ObjectModel model(std::string const& yaml) {
    auto const file = read_yaml<ModelFile>(path_, yaml);
    std::optional<TriangleMesh> mesh;
    if (!file.mesh.empty()) {
      mesh = one_triangle();
    }
    return model_of(file, std::move(mesh), path_.string());
  }
  ObjectModel named(std::string const& yaml) { return model("name: thing\n" + yaml); }
  std::string error(std::string const& yaml) {
    return error_in(path_, [&] { (void)model(yaml); });
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "thing.yaml";
};

std::vector<Solid> const& solids_of(ObjectModel const& model) {
  return std::get<std::vector<Solid>>(model.shape);
}

void expect_box(Solid const& solid, Vector3d const& low_m, Vector3d const& high_m) {
  BoxSolid const& box = std::get<BoxSolid>(solid);
  EXPECT_LT((box.low_m - low_m).norm(), 1e-12) << box.low_m.transpose();
  EXPECT_LT((box.high_m - high_m).norm(), 1e-12) << box.high_m.transpose();
}

/// Told by where x and z go, which leaves nothing open.
void expect_turn(Eigen::Quaterniond const& turn, Vector3d const& x_to, Vector3d const& z_to) {
  EXPECT_LT((turn * Vector3d::UnitX() - x_to).norm(), 1e-12) << turn.coeffs().transpose();
  EXPECT_LT((turn * Vector3d::UnitZ() - z_to).norm(), 1e-12) << turn.coeffs().transpose();
}

void expect_half_turn(Symmetry const& symmetry) {
  EXPECT_FALSE(symmetry.axis.has_value());
  ASSERT_THAT(symmetry.rotations, SizeIs(1));
  expect_turn(symmetry.rotations[0], -Vector3d::UnitX(), Vector3d::UnitZ());
}

void expect_quarter_turns(Symmetry const& symmetry) {
  EXPECT_FALSE(symmetry.axis.has_value());
  ASSERT_THAT(symmetry.rotations, SizeIs(3));
  expect_turn(symmetry.rotations[0], -Vector3d::UnitX(), Vector3d::UnitZ());
  expect_turn(symmetry.rotations[1], Vector3d::UnitY(), Vector3d::UnitZ());
  expect_turn(symmetry.rotations[2], -Vector3d::UnitY(), Vector3d::UnitZ());
}

void expect_axis(Symmetry const& symmetry, Vector3d const& direction, Vector3d const& point_m) {
  EXPECT_THAT(symmetry.rotations, IsEmpty());
  ASSERT_TRUE(symmetry.axis.has_value());
  EXPECT_LT((symmetry.axis->direction - direction).norm(), 1e-12)
      << symmetry.axis->direction.transpose();
  EXPECT_EQ(symmetry.axis->point_m, point_m);
}

void expect_no_symmetry(Symmetry const& symmetry) {
  EXPECT_FALSE(symmetry.axis.has_value());
  EXPECT_THAT(symmetry.rotations, IsEmpty());
}

TEST_F(ModelFileTest, ABoxStandsOnTheCentreOfItsBase) {
  ObjectModel const box = model("name: crate\nprimitive:\n  box: [0.2, 0.4, 0.3]\n");
  EXPECT_EQ(box.name, "crate");
  ASSERT_THAT(solids_of(box), SizeIs(1));
  expect_box(solids_of(box)[0], {-0.1, -0.2, 0}, {0.1, 0.2, 0.3});
}

TEST_F(ModelFileTest, ACylinderStandsOnTheCentreOfItsBase) {
  ObjectModel const can = named("primitive: {cylinder: {radius: 0.05, height: 0.2}}\n");
  ASSERT_THAT(solids_of(can), SizeIs(1));
  auto const& cylinder = std::get<CylinderSolid>(solids_of(can)[0]);
  EXPECT_EQ(cylinder.radius_m, 0.05);
  EXPECT_EQ(cylinder.height_m, 0.2);
}

TEST_F(ModelFileTest, ATableIsATopOnFourLegs) {
  ObjectModel const table =
      named("primitive: {table: {top: [0.8, 1.2], thickness: 0.04, height: 0.72, leg: 0.06}}\n");
  ASSERT_THAT(solids_of(table), SizeIs(5));
  expect_box(solids_of(table)[0], {-0.4, -0.6, 0.68}, {0.4, 0.6, 0.72});
  expect_box(solids_of(table)[1], {-0.4, -0.6, 0}, {-0.34, -0.54, 0.68});
  expect_box(solids_of(table)[2], {-0.4, 0.54, 0}, {-0.34, 0.6, 0.68});
  expect_box(solids_of(table)[3], {0.34, -0.6, 0}, {0.4, -0.54, 0.68});
  expect_box(solids_of(table)[4], {0.34, 0.54, 0}, {0.4, 0.6, 0.68});
}

TEST_F(ModelFileTest, AMeshIsTakenAsItComes) {
  ObjectModel const mesh = named("mesh: thing.ply\n");
  EXPECT_THAT(std::get<TriangleMesh>(mesh.shape).triangles, SizeIs(1));
  expect_no_symmetry(mesh.symmetry);
}

TEST_F(ModelFileTest, AMeshIsSeenFromBothSidesUnlessToldOtherwise) {
  EXPECT_FALSE(named("mesh: thing.ply\n").one_sided);
  EXPECT_FALSE(named("primitive: {box: [1, 1, 1]}\n").one_sided);
  EXPECT_TRUE(named("mesh: thing.ply\none_sided: true\n").one_sided);
}

TEST_F(ModelFileTest, AMeshIsInMetresUnlessToldOtherwise) {
  EXPECT_EQ(read_yaml<ModelFile>(path_, "mesh: a.ply\n").unit, LengthUnit::kMetre);
  EXPECT_EQ(read_yaml<ModelFile>(path_, "unit: m\n").unit, LengthUnit::kMetre);
  EXPECT_EQ(read_yaml<ModelFile>(path_, "unit: mm\n").unit, LengthUnit::kMillimetre);
}

TEST_F(ModelFileTest, PrimitivesHaveTheSymmetryOfTheirShape) {
  expect_half_turn(named("primitive: {box: [0.2, 0.4, 0.2]}\n").symmetry);
  expect_quarter_turns(named("primitive: {box: [0.2, 0.2, 0.4]}\n").symmetry);
  expect_axis(named("primitive: {cylinder: {radius: 0.1, height: 0.2}}\n").symmetry,
              Vector3d::UnitZ(), {0, 0, 0});
  expect_half_turn(
      named("primitive: {table: {top: [0.8, 1.2], thickness: 0.04, height: 0.7, leg: 0.06}}\n")
          .symmetry);
  expect_quarter_turns(
      named("primitive: {table: {top: [1.2, 1.2], thickness: 0.04, height: 0.7, leg: 0.06}}\n")
          .symmetry);
}

TEST_F(ModelFileTest, OwnIsWhatGoesWithoutSaying) {
  expect_half_turn(named("primitive: {box: [0.2, 0.4, 0.2]}\nsymmetry: own\n").symmetry);
  expect_no_symmetry(named("mesh: a.ply\nsymmetry: own\n").symmetry);
}

TEST_F(ModelFileTest, NoneTakesAPrimitivesOwnSymmetryAway) {
  expect_no_symmetry(named("primitive: {box: [1, 1, 1]}\nsymmetry: none\n").symmetry);
  expect_no_symmetry(
      named("primitive: {cylinder: {radius: 1, height: 1}}\nsymmetry: none\n").symmetry);
}

TEST_F(ModelFileTest, AnAxisReplacesThePrimitivesOwnSymmetry) {
  std::string const box = "primitive: {box: [1, 1, 1]}\n";
  expect_axis(named(box + "symmetry: {axis: [0, 3, 4], point: [0.1, -0.2, 0.3]}\n").symmetry,
              {0, 0.6, 0.8}, {0.1, -0.2, 0.3});
  Symmetry const both = named(box + "symmetry: {axis: [0, 0, 1], both_ways: true}\n").symmetry;
  ASSERT_TRUE(both.axis);
  EXPECT_TRUE(both.axis->both_ways);
  EXPECT_FALSE(named(box + "symmetry: {axis: [0, 0, 1]}\n").symmetry.axis->both_ways);
  expect_axis(named(box + "symmetry: {axis: [0, -2, 0]}\n").symmetry, {0, -1, 0}, {0, 0, 0});
}

TEST_F(ModelFileTest, AnAxisMayBeOfAnyLengthButNone) {
  for (std::string const length : {"1e-6", "1", "1e200"}) {
    expect_axis(named("mesh: a.ply\nsymmetry: {axis: [0, " + length + ", 0]}\n").symmetry,
                {0, 1, 0}, {0, 0, 0});
  }
}

// Were it z and then x, x would go to z.
TEST_F(ModelFileTest, TurnsAreAboutTheFixedAxesXThenYThenZ) {
  for (char const* turns : {"[[90, 0, 90], [0, 90, 0]]", "[{rpy_deg: [90, 0, 90]}, [0, 90, 0]]"}) {
    Symmetry const symmetry =
        named("primitive: {cylinder: {radius: 1, height: 1}}\nsymmetry: " + std::string(turns))
            .symmetry;
    EXPECT_FALSE(symmetry.axis.has_value());
    ASSERT_THAT(symmetry.rotations, SizeIs(2));
    expect_turn(symmetry.rotations[0], Vector3d::UnitY(), Vector3d::UnitX());
    expect_turn(symmetry.rotations[1], -Vector3d::UnitZ(), Vector3d::UnitX());
  }
}

TEST_F(ModelFileTest, AnEmptyListOfTurnsIsNone) {
  expect_no_symmetry(named("primitive: {box: [1, 1, 1]}\nsymmetry: []\n").symmetry);
}

struct Golden {
  std::string yaml;
  std::string error;
};

class ModelFileError : public ModelFileTest, public testing::WithParamInterface<Golden> {};

TEST_P(ModelFileError, IsGolden) {
  EXPECT_EQ(error("name: thing\n" + GetParam().yaml), GetParam().error);
}

constexpr char const* kOneShape =
    "FILE: give one of primitive.box, primitive.cylinder, primitive.table and mesh";

INSTANTIATE_TEST_SUITE_P(
    OneShape, ModelFileError,
    testing::Values(Golden{"", kOneShape}, Golden{"primitive:\n", kOneShape},
                    Golden{"primitive: {box: [1, 1, 1]}\nmesh: a.ply\n", kOneShape},
                    Golden{"primitive: {box: [1, 1, 1], cylinder: {radius: 1, height: 1}}\n",
                           kOneShape},
                    Golden{"primitive: {box: [1, 1, 1], table: {leg: 0.1}}\n", kOneShape},
                    Golden{"primitive: {cylinder: {height: 1}}\nmesh: a.ply\n", kOneShape}));

constexpr char const* kWholeTable = "FILE: primitive.table needs top, thickness, height and leg";
constexpr char const* kTwoLegs =
    "FILE: primitive.table: two legs must fit under each side of the top";

INSTANTIATE_TEST_SUITE_P(
    Incomplete, ModelFileError,
    testing::Values(
        Golden{"primitive: {cylinder: {radius: 1}}\n",
               "FILE: primitive.cylinder needs radius and height"},
        Golden{"primitive: {cylinder: {height: 1}}\n",
               "FILE: primitive.cylinder needs radius and height"},
        Golden{"primitive: {table: {thickness: 0.1, height: 1, leg: 0.1}}\n", kWholeTable},
        Golden{"primitive: {table: {top: [1, 1], height: 1, leg: 0.1}}\n", kWholeTable},
        Golden{"primitive: {table: {top: [1, 1], thickness: 0.1, leg: 0.1}}\n", kWholeTable},
        Golden{"primitive: {table: {top: [1, 1], thickness: 0.1, height: 1}}\n", kWholeTable},
        Golden{"primitive: {box: [1, 1, 1]}\nsymmetry: {}\n",
               "FILE: symmetry.axis must be a direction that is not 0, 0, 0"},
        Golden{"primitive: {box: [1, 1, 1]}\nsymmetry: {point: [0, 0, 1]}\n",
               "FILE: symmetry.axis must be a direction that is not 0, 0, 0"},
        Golden{"primitive: {box: [1, 1, 1]}\nsymmetry: [[0, 0, 90], {}]\n",
               "FILE: symmetry[1] needs rpy_deg"}));

INSTANTIATE_TEST_SUITE_P(
    Impossible, ModelFileError,
    testing::Values(
        Golden{"primitive: {table: {top: [1, 1], thickness: 0.7, height: 0.7, leg: 0.1}}\n",
               "FILE: primitive.table: thickness must be less than height"},
        Golden{"primitive: {table: {top: [1, 0.5], thickness: 0.1, height: 1, leg: 0.26}}\n",
               kTwoLegs},
        Golden{"primitive: {table: {top: [0.5, 1], thickness: 0.1, height: 1, leg: 0.26}}\n",
               kTwoLegs},
        Golden{"primitive: {table: {top: [0.5, 1], thickness: 0.1, height: 1, leg: 0.25}}\n", ""},
        Golden{"primitive: {box: [20, 15, 25]}\nunit: mm\n",
               "FILE: unit is that of a mesh's numbers; primitives are in metres"},
        Golden{"mesh: a.ply\nunit: mm\n", ""},
        Golden{"primitive: {box: [1, 1, 1]}\none_sided: true\n",
               "FILE: one_sided tells of a mesh; primitives are closed"},
        Golden{"primitive: {box: [1, 1, 1]}\nsymmetry: {axis: [0, 0, 0]}\n",
               "FILE: symmetry.axis must be a direction that is not 0, 0, 0"}));

INSTANTIATE_TEST_SUITE_P(
    Values, ModelFileError,
    testing::Values(
        Golden{"primitive:\n  box: [1, 1]\n",
               "FILE:3:3: primitive.box: must be a list of 3 numbers"},
        Golden{"primitive:\n  box: 1\n", "FILE:3:3: primitive.box: must be a list of 3 numbers"},
        Golden{"primitive:\n  box: [1, -1, 1]\n",
               "FILE:3:3: primitive.box[1] = -1: must be in [0.0001, 100] m"},
        Golden{"primitive:\n  box: [1, 1, 0]\n",
               "FILE:3:3: primitive.box[2] = 0: must be in [0.0001, 100] m"},
        Golden{"primitive:\n  cylinder: {radius: -0.1, height: 1}\n",
               "FILE:3:14: primitive.cylinder.radius = -0.1: must be in [0.0001, 100] m"},
        Golden{"primitive:\n  cylinder: {radius: 0.1, height: 1000}\n",
               "FILE:3:27: primitive.cylinder.height = 1000: must be in [0.0001, 100] m"},
        Golden{"primitive:\n  table: {top: [1, 1, 1], thickness: 0.1, height: 1, leg: 0.1}\n",
               "FILE:3:11: primitive.table.top: must be a list of 2 numbers"},
        Golden{"unit: inch\n", "FILE:2:1: unit = inch: must be one of m, mm"},
        Golden{"symmetry: all\n", "FILE:2:1: symmetry = all: must be one of own, none"},
        Golden{"symmetry: {axis: [0, 1]}\n",
               "FILE:2:12: symmetry.axis: must be a list of 3 numbers"},
        Golden{"symmetry:\n  - [0, 0, 180]\n  - [0, 0, 400]\n",
               "FILE:4:5: symmetry[1][2] = 400: must be in [-360, 360] deg"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, ModelFileError,
    testing::Values(
        Golden{"primitve: {box: [1, 1, 1]}\n",
               "FILE:2:1: unknown key primitve (did you mean primitive?)"},
        Golden{"primitive: {ball: {radius: 1}}\n", "FILE:2:13: unknown key primitive.ball"},
        Golden{"primitive: {cylinder: {raduis: 1}}\n",
               "FILE:2:24: unknown key primitive.cylinder.raduis (did you mean radius?)"},
        Golden{"symmetry: {axes: [0, 0, 1]}\n",
               "FILE:2:12: unknown key symmetry.axes (did you mean axis?)"}));

TEST_F(ModelFileTest, WithoutANameThereIsNoModel) {
  EXPECT_EQ(error("primitive: {box: [1, 1, 1]}\n"), "FILE: a model needs a name");
}

}  // namespace
}  // namespace credo::test
