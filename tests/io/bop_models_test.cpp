#include "io/bop_models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>

#include "core/error.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

constexpr char const* kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n100 0 0\n0 100 0\n0 0 100\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

void write_models(TempFolder const& folder, std::string const& info) {
  write_text(folder / "obj_000002.ply", kTetrahedron);
  write_text(folder / "obj_000011.ply", kTetrahedron);
  write_text(folder / "models_info.json", info);
}

std::string refusal(TempFolder const& folder) {
  try {
    static_cast<void>(read_bop_models(folder.path(), "set"));
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

TEST(BopModels, InOrderInMetresWithTheirSymmetry) {
  TempFolder const folder;
  write_models(folder, R"({
    "11": {"symmetries_discrete": [[-1,0,0,0.5, 0,-1,0,0, 0,0,1,0, 0,0,0,1]]},
    "2": {"symmetries_continuous": [{"axis": [0,0,2], "offset": [10,0,0]}]}})");
  std::vector<ObjectModel> const models = read_bop_models(folder.path(), "set");
  ASSERT_EQ(models.size(), 2U);
  EXPECT_EQ(models[0].name, "set_2");
  EXPECT_EQ(models[1].name, "set_11");
  auto const& mesh = std::get<TriangleMesh>(models[0].shape);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  float farthest = 0.0F;
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    farthest = std::max(farthest, vertex.norm());
  }
  EXPECT_NEAR(farthest, 0.1, 1e-6);
  ASSERT_TRUE(models[0].symmetry.axis);
  EXPECT_EQ(models[0].symmetry.axis->direction, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(models[0].symmetry.axis->point_m.x(), 0.01, 1e-12);
  ASSERT_EQ(models[1].symmetry.rotations.size(), 1U);
  EXPECT_LT(
      (models[1].symmetry.rotations[0] * Eigen::Vector3d(1, 2, 3) - Eigen::Vector3d(-1, -2, 3))
          .norm(),
      1e-9);
}

TEST(BopModels, TurnsBesideAnAxisAreEndForEnd) {
  TempFolder const folder;
  write_models(folder, R"({
    "2": {"symmetries_continuous": [{"axis": [0,0,1], "offset": [0,0,0]}],
          "symmetries_discrete": [[1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,0,1]]},
    "11": {"symmetries_continuous": [{"axis": [0,0,1], "offset": [0,0,0]}]}})");
  std::vector<ObjectModel> const models = read_bop_models(folder.path(), "set");
  EXPECT_TRUE(models[0].symmetry.axis->both_ways);
  EXPECT_FALSE(models[1].symmetry.axis->both_ways);
}

TEST(BopModels, SayWhatIsWrong) {
  TempFolder const folder;
  EXPECT_THAT(refusal(folder), testing::HasSubstr("models_info.json: cannot be read"));
  write_models(folder, R"({"2": {"symmetries_discrete": [[1,0,0,9, 0,1,0,0, 0,0,1,0, 0,0,0,1]]}})");
  EXPECT_THAT(refusal(folder), testing::HasSubstr("shifts by more than 2 mm"));
  write_models(folder, R"({"3": {}})");
  EXPECT_THAT(refusal(folder), testing::HasSubstr("obj_000003.ply"));
  write_models(folder, R"([1, 2)");
  EXPECT_THAT(refusal(folder), testing::HasSubstr("not a list of BOP models"));
}

}  // namespace
}  // namespace credo::test
