#pragma once

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "core/object_model.hpp"

namespace credo::test {

/// A closed cube with a corner at the origin; its last two triangles are its lid.
inline TriangleMesh cube(float side) {
  TriangleMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back(side * Eigen::Vector3f((i & 1U) != 0 ? 1.0F : 0.0F,
                                                   (i & 2U) != 0 ? 1.0F : 0.0F,
                                                   (i & 4U) != 0 ? 1.0F : 0.0F));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {1, 3, 7}, {1, 7, 5},
                    {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

inline TriangleMesh without_lid(TriangleMesh mesh) {
  mesh.triangles.resize(mesh.triangles.size() - 2);
  return mesh;
}

inline TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

inline std::string text_of(Eigen::Vector3f const& p) {
  std::ostringstream text;
  text << p.x() << ' ' << p.y() << ' ' << p.z();
  return text.str();
}

inline std::string ply_header(std::string const& format, TriangleMesh const& mesh) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
         std::to_string(mesh.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ply_text(TriangleMesh const& mesh) {
  std::string text = ply_header("ascii", mesh);
  for (auto const& p : mesh.vertices) {
    text += text_of(p) + "\n";
  }
  for (auto const& [a, b, c] : mesh.triangles) {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  }
  return text;
}

inline std::string obj_text(TriangleMesh const& mesh) {
  std::string text = "mtllib none.mtl\no thing\n";
  for (auto const& p : mesh.vertices) {
    text += "v " + text_of(p) + "\n";
  }
  for (auto const& [a, b, c] : mesh.triangles) {
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
            std::to_string(c + 1) + "\n";
  }
  return text;
}

inline std::string stl_text(TriangleMesh const& mesh) {
  std::string text = "solid thing\n";
  for (auto const& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (auto const vertex : triangle) {
      text += "vertex " + text_of(mesh.vertices[vertex]) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid thing\n";
}

/// A Collada scene in which one mesh stands wherever one of these matrices (row by row) puts it.
inline std::string collada_text(TriangleMesh const& mesh, std::vector<std::string> const& places) {
  std::string numbers;
  for (auto const& p : mesh.vertices) {
    numbers += text_of(p) + " ";
  }
  std::string indices;
  for (auto const& triangle : mesh.triangles) {
    for (auto const vertex : triangle) {
      indices += std::to_string(vertex) + " ";
    }
  }
  std::string nodes;
  for (std::string const& place : places) {
    nodes += "<node><matrix>" + place + "</matrix><instance_geometry url=\"#mesh\"/></node>";
  }
  std::string const count = std::to_string(mesh.vertices.size());
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="mesh"><mesh>
<source id="p"><float_array id="a" count=")" +
         std::to_string(3 * mesh.vertices.size()) + "\">" + numbers +
         R"(</float_array><technique_common><accessor source="#a" stride="3" count=")" + count +
         R"("><param name="X" type="float"/><param name="Y" type="float"/>)" +
         R"(<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count=")" +
         std::to_string(mesh.triangles.size()) +
         R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices +
         R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">)" +
         nodes + R"(</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

}  // namespace credo::test
