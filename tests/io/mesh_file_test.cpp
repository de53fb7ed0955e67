#include "io/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "mesh_texts.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::cube;
using test::TempFolder;
using test::write_text;

double volume_of(TriangleMesh const& mesh) {
  double volume = 0.0;
  for (auto const& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].cast<double>().dot(
        mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>()));
  }
  return volume / 6.0;
}

Eigen::AlignedBox3d box_of(TriangleMesh const& mesh) {
  Eigen::AlignedBox3d box;
  for (Eigen::Vector3f const& p : mesh.vertices) {
    box.extend(p.cast<double>());
  }
  return box;
}

class MeshFileTest : public testing::Test {
protected:
  LoadedMesh read(std::string const& name, std::string const& text,
                  LengthUnit unit = LengthUnit::kMetre) {
    write_text(folder_ / name, text);
    return read_mesh(folder_ / name, unit);
  }

  /// The error for this file without the path, which must come first.
  std::string error_at(std::string const& name, LengthUnit unit = LengthUnit::kMetre) {
    std::string const path = folder_ / name;
    try {
      read_mesh(path, unit);
    } catch (InputError const& error) {
      std::string const message = error.what();
      EXPECT_EQ(message.rfind(path + ": ", 0), 0U) << message;
      EXPECT_THAT(message, testing::Not(testing::HasSubstr("\n")));
      return message.substr(path.size() + 2);
    }
    return "no error";
  }
  std::string error_of(std::string const& name, std::string const& text,
                       LengthUnit unit = LengthUnit::kMetre) {
    write_text(folder_ / name, text);
    return error_at(name, unit);
  }

  TempFolder folder_;
};

void expect_unit_cube(LoadedMesh const& loaded) {
  EXPECT_EQ(loaded.mesh.vertices.size(), 8U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 12U);
  EXPECT_EQ(loaded.boundary_edges, 0U);
  EXPECT_NEAR(volume_of(loaded.mesh), 1.0, 1e-12);
  EXPECT_EQ(box_of(loaded.mesh).min(), Eigen::Vector3d::Zero());
  EXPECT_EQ(box_of(loaded.mesh).max(), Eigen::Vector3d::Ones());
}

TEST_F(MeshFileTest, ReadsACubeInAnyFormat) {
  expect_unit_cube(read("cube.ply", test::ply_text(cube(1))));
  expect_unit_cube(read("cube.obj", test::obj_text(cube(1))));
  expect_unit_cube(read("cube.STL", test::stl_text(cube(1))));
}

TEST_F(MeshFileTest, KeepsTheOrderOfAFileThatNeedsNoMending) {
  TriangleMesh const mesh = read("cube.ply", test::ply_text(cube(1))).mesh;
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.vertices[1], cube(1).vertices[2]) << "vertices come as triangles name them";
}

TEST_F(MeshFileTest, PolygonsBecomeTriangles) {
  expect_unit_cube(read("cube.obj",
                        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"));
}

TEST_F(MeshFileTest, VerticesJoinOnlyAtTheVerySamePosition) {
  // The second triangle's copies of the shared edge: one with a zero of the other sign, one a float
  // further.
  auto const read_with = [&](std::string const& copy) {
    return read("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0.0 0 0\nv " + copy +
                               " 0 0\nv 0 -1 0\nf 1 2 3\nf 5 4 6\n");
  };
  EXPECT_EQ(read_with("1").mesh.vertices.size(), 4U);
  EXPECT_EQ(read_with("1").boundary_edges, 4U);
  EXPECT_EQ(read_with("1.0000001").mesh.vertices.size(), 5U);
  EXPECT_EQ(read_with("1.0000001").boundary_edges, 6U);
}

TEST_F(MeshFileTest, AnOpenMeshTellsItsBoundary) {
  LoadedMesh const loaded = read("open.ply", test::ply_text(test::without_lid(cube(1))));
  EXPECT_EQ(loaded.mesh.vertices.size(), 8U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 10U);
  EXPECT_EQ(loaded.boundary_edges, 4U);
}

TEST_F(MeshFileTest, TrianglesThatTurnTheSameWayAlongAnEdgeDoNotCloseIt) {
  TriangleMesh mesh = cube(1);
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  EXPECT_EQ(read("turned.ply", test::ply_text(mesh)).boundary_edges, 3U);
  mesh = cube(1);
  mesh.triangles.push_back(mesh.triangles[0]);
  EXPECT_EQ(read("twice.ply", test::ply_text(mesh)).boundary_edges, 3U);
}

TEST_F(MeshFileTest, MillimetresBecomeMetres) {
  LoadedMesh const loaded = read("cube.stl", test::stl_text(cube(50)), LengthUnit::kMillimetre);
  EXPECT_TRUE(box_of(loaded.mesh).max().isApprox(Eigen::Vector3d::Constant(0.05), 1e-6));
  EXPECT_EQ(loaded.mesh.vertices.size(), 8U);
  EXPECT_EQ(loaded.boundary_edges, 0U);
}

TEST_F(MeshFileTest, AClosedMeshIsTurnedOutside) {
  expect_unit_cube(read("cube.ply", test::ply_text(test::inside_out(cube(1)))));
}

TEST_F(MeshFileTest, AnOpenMeshIsNotTurned) {
  TriangleMesh const bowl = test::inside_out(test::without_lid(cube(1)));
  EXPECT_LT(volume_of(read("bowl.ply", test::ply_text(bowl)).mesh), 0.0);
}

TEST_F(MeshFileTest, TrianglesOfNoAreaAreLeftOut) {
  // Vertices 8 and 9 are on an edge of the cube and far away; 10 is where 0 is.
  TriangleMesh mesh = cube(0.3F);
  mesh.vertices.insert(mesh.vertices.end(),
                       {{0.1F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.0F}, mesh.vertices[0]});
  mesh.triangles.insert(mesh.triangles.end(), {{0, 10, 7}, {3, 3, 5}});
  LoadedMesh loaded = read("cube.ply", test::ply_text(mesh));
  EXPECT_EQ(loaded.mesh.vertices.size(), 8U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 12U);
  EXPECT_EQ(loaded.boundary_edges, 0U);

  mesh.triangles.push_back({0, 8, 1});
  loaded = read("cube.ply", test::ply_text(mesh));
  EXPECT_EQ(loaded.mesh.vertices.size(), 8U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 12U);
}

TEST_F(MeshFileTest, ASeamFilledByAFlatTriangleIsOpen) {
  // Vertex 8 halves the edge 0-1 of the bottom; the side keeps the whole edge.
  TriangleMesh mesh = cube(0.3F);
  mesh.vertices.emplace_back(0.1F, 0.0F, 0.0F);
  mesh.triangles[1] = {0, 3, 8};
  mesh.triangles.insert(mesh.triangles.end(), {{8, 3, 1}, {0, 8, 1}});
  LoadedMesh const loaded = read("cube.ply", test::ply_text(mesh));
  EXPECT_EQ(loaded.boundary_edges, 3U) << "0-1, 0-8 and 8-1";
  EXPECT_EQ(loaded.mesh.vertices.size(), 9U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 13U);
}

TEST_F(MeshFileTest, PointsAndLinesArePassedOver) {
  expect_unit_cube(read("cube.obj", test::obj_text(cube(1)) + "v 99 99 99\np 9\nl 1 9\n"));
}

TEST_F(MeshFileTest, PlacesEveryInstanceOfAScene) {
  std::string const there = "1 0 0 0  0 1 0 0  0 0 1 5  0 0 0 1";
  std::string const mirrored = "-1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1";
  LoadedMesh const loaded = read("two.dae", test::collada_text(cube(1), {there, mirrored}));
  EXPECT_EQ(loaded.mesh.vertices.size(), 16U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 24U);
  EXPECT_EQ(loaded.boundary_edges, 0U);
  EXPECT_NEAR(volume_of(loaded.mesh), 2.0, 1e-9);
  EXPECT_EQ(box_of(loaded.mesh).min(), Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(box_of(loaded.mesh).max(), Eigen::Vector3d(1, 1, 6));
}

TEST_F(MeshFileTest, ASizeOfNoObjectAsksForTheUnit) {
  auto const error_with = [&](float side, LengthUnit unit) {
    return error_of("box.ply", test::ply_text(cube(side)), unit);
  };
  EXPECT_EQ(error_with(2000, LengthUnit::kMetre), "is 2000 m across in m; should its unit be mm?");
  EXPECT_EQ(error_with(0.1F, LengthUnit::kMillimetre),
            "is 0.0001 m across in mm; should its unit be m?");
  std::string const check = "must be between 0.001 and 20 m: check its unit";
  EXPECT_EQ(error_with(0.0001F, LengthUnit::kMetre), "is 0.0001 m across in m; " + check);
  EXPECT_EQ(error_with(50000, LengthUnit::kMetre), "is 50000 m across in m; " + check);
  EXPECT_EQ(error_with(50000, LengthUnit::kMillimetre), "is 50 m across in mm; " + check);
  EXPECT_EQ(error_with(20, LengthUnit::kMetre), "no error");
  EXPECT_EQ(error_with(0.001F, LengthUnit::kMetre), "no error");
}

TEST_F(MeshFileTest, AMeshWithoutTrianglesIsNone) {
  std::string const none = "has no triangles; a model needs faces";
  TriangleMesh points = cube(1);
  points.triangles.clear();
  EXPECT_EQ(error_of("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\n"), none);
  EXPECT_EQ(error_of("points.ply", test::ply_text(points)), none);
  EXPECT_EQ(error_of("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), none);
}

TEST_F(MeshFileTest, VerticesMustBeFinite) {
  EXPECT_EQ(error_of("nan.obj", "v 0 0 0\nv nan 1 0\nv 0 1 0\nf 1 2 3\n"),
            "has a vertex that is not finite: nan 1 0");
  EXPECT_EQ(error_of("nan.obj", "v 0 0 0\nv 1 0 0\nv 1 1 inf\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n"),
            "has a vertex that is not finite: 1 1 inf");
}

TEST_F(MeshFileTest, WhatIsNoMeshSaysSo) {
  EXPECT_EQ(error_at("none.ply"), "mesh cannot be read");
  EXPECT_EQ(error_at(""), "is a folder; a mesh is a file");
  std::string const no_mesh = "is no mesh that can be read: ";
  EXPECT_EQ(error_of("a.obj", ""), no_mesh + "OBJ-file is too small.");
  EXPECT_EQ(error_of("a.dae", "<"), no_mesh + "Unable to read file, malformed XML");
  EXPECT_EQ(error_of("a.ply", "hello\nworld\n"),
            no_mesh + "Invalid .ply file: Incorrect magic number (expected 'ply' or 'PLY').");
  EXPECT_EQ(error_of("a.none", "hello\nworld\n"),
            no_mesh + "No suitable reader found for the file format of file \"" +
                std::string(folder_ / "a.none") + "\".");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
            no_mesh + "OBJ: vertex index out of range");
  std::string const cube_text = test::ply_text(cube(1));
  std::string const head = cube_text.substr(0, cube_text.rfind("3 "));
  EXPECT_EQ(error_of("a.ply", head + "4 0 1 2 8\n"), no_mesh + "face 11 names vertex 8 of 8");
  EXPECT_EQ(error_of("a.ply", head + "0\n"), no_mesh + "face 11 has no vertices");
}

TEST_F(MeshFileTest, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  read("cube.obj", test::obj_text(cube(1)));
  error_of("a.ply", "hello\nworld\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

struct Linemod {
  int number;
  std::size_t triangles;
  std::size_t boundary_edges;
  /// models_info.json measured other versions of the models: an independent reader of these files
  /// finds number 10 0.86 mm deeper, and the others off by up to 0.101 mm.
  double tolerance_mm = 0.11;
};

class LinemodTest : public testing::TestWithParam<Linemod> {};

TEST_P(LinemodTest, HasItsSizeAndBoundary) {
  CREDO_REQUIRE_RECORDING("objects/lmo");
  Linemod const& expected = GetParam();
  std::filesystem::path const folder = test::recordings() / "objects/lmo";
  std::string const number = std::to_string(expected.number);
  std::string const name = "obj_" + std::string(6 - number.size(), '0') + number + ".ply";
  LoadedMesh const loaded = read_mesh(folder / name, LengthUnit::kMillimetre);
  EXPECT_EQ(loaded.mesh.triangles.size(), expected.triangles);
  EXPECT_EQ(loaded.boundary_edges, expected.boundary_edges);
  EXPECT_GT(volume_of(loaded.mesh), 0.0);
  std::ifstream file(folder / "models_info.json");
  auto const info = nlohmann::json::parse(file).at(number);
  Eigen::AlignedBox3d const box = box_of(loaded.mesh);
  for (int axis = 0; axis < 3; ++axis) {
    std::string const letter(1, "xyz"[axis]);
    EXPECT_NEAR(1e3 * box.min()[axis], info.at("min_" + letter).get<double>(),
                expected.tolerance_mm);
    EXPECT_NEAR(1e3 * box.sizes()[axis], info.at("size_" + letter).get<double>(),
                expected.tolerance_mm);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LinemodTest,
                         testing::Values(Linemod{1, 5646, 0}, Linemod{5, 18688, 0},
                                         Linemod{6, 9338, 0}, Linemod{8, 20426, 0},
                                         Linemod{9, 7054, 0}, Linemod{10, 15642, 92, 0.9},
                                         Linemod{11, 6830, 0}, Linemod{12, 13828, 1}),
                         [](testing::TestParamInfo<Linemod> const& test) {
                           return "Number" + std::to_string(test.param.number);
                         });

}  // namespace
}  // namespace credo
