#include "io/ply_writer.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

TriangleMesh roof() {
  TriangleMesh mesh;
  mesh.vertices = {{-0.1F, -0.1F, 0},      {-0.1F, 0.1F, 0.0001F}, {1e-7F, -0.1F, 0.06F},
                   {0, 0.1F, 1.0F / 3.0F}, {0.1F, -0.1F, 0},       {0.1F, 0.1F, 0}};
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
  return mesh;
}

/// Vertices in the order of the triangles, as the reader numbers them.
std::vector<Eigen::Vector3f> corners(TriangleMesh const& mesh) {
  std::vector<Eigen::Vector3f> all;
  for (auto const& triangle : mesh.triangles) {
    for (std::uint32_t const i : triangle) {
      all.push_back(mesh.vertices[i]);
    }
  }
  return all;
}

TEST(PlyWriter, WhatIsWrittenIsReadToTheBit) {
  TempFolder const folder;
  write_ply(folder / "roof.ply", roof());
  LoadedMesh const loaded = read_mesh(folder / "roof.ply", LengthUnit::kMetre);
  EXPECT_EQ(corners(loaded.mesh), corners(roof()));
  EXPECT_EQ(loaded.boundary_edges, 6U);
}

TEST(PlyWriter, WhatCannotBeWrittenIsTold) {
  TempFolder const folder;
  EXPECT_THROW(write_ply(folder / "no/roof.ply", roof()), InputError);
  EXPECT_THROW(write_ply("/dev/full", roof()), InputError);
}

}  // namespace
}  // namespace credo::test
