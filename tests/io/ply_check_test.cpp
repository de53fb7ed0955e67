#include "io/ply_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "mesh_texts.hpp"
#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::cube;
using test::TempFolder;
using test::write_text;

template <typename T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes(reinterpret_cast<char const*>(&value), sizeof value);
  if (big_endian) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

std::string binary_ply(TriangleMesh const& mesh, bool big_endian) {
  std::string text =
      test::ply_header(big_endian ? "binary_big_endian" : "binary_little_endian", mesh);
  for (auto const& p : mesh.vertices) {
    for (float const value : p) {
      text += bytes_of(value, big_endian);
    }
  }
  for (auto const& triangle : mesh.triangles) {
    text += '\3';
    for (auto const vertex : triangle) {
      text += bytes_of(vertex, big_endian);
    }
  }
  return text;
}

class PlyCheckTest : public testing::Test {
protected:
  /// The error for this text without the path, which must come first.
  std::string error_of(std::string const& text) {
    std::string const path = folder_ / "thing.ply";
    write_text(path, text);
    try {
      check_ply(path);
    } catch (InputError const& error) {
      std::string const message = error.what();
      EXPECT_EQ(message.rfind(path + ": ", 0), 0U) << message;
      return message.substr(path.size() + 2);
    }
    return "no error";
  }

  TempFolder folder_;
};

std::string const kBroken = "PLY data are damaged or cut short in ";

TEST_F(PlyCheckTest, WholeFilesPass) {
  EXPECT_EQ(error_of(test::ply_text(cube(1))), "no error");
  for (bool const big_endian : {false, true}) {
    std::string const text = binary_ply(cube(1), big_endian);
    EXPECT_EQ(error_of(text), "no error");
    LoadedMesh const loaded = read_mesh(folder_ / "thing.ply", LengthUnit::kMetre);
    EXPECT_EQ(loaded.mesh.vertices.size(), 8U);
    EXPECT_EQ(loaded.mesh.triangles.size(), 12U);
  }
}

TEST_F(PlyCheckTest, OtherFilesPass) {
  EXPECT_EQ(error_of(""), "no error");
  EXPECT_EQ(error_of("solid thing\n"), "no error");
  EXPECT_EQ(error_of("plywood\n"), "no error");
}

TEST_F(PlyCheckTest, EveryCutIsSeen) {
  for (std::string const& text : {binary_ply(cube(1), false), binary_ply(cube(1), true)}) {
    for (std::size_t length = 4; length < text.size(); ++length) {
      EXPECT_NE(error_of(text.substr(0, length)), "no error") << "after " << length << " bytes";
    }
  }
  std::string const text = test::ply_text(cube(1));
  // The last two are a digit and the end of the line: a number cut short is a number.
  for (std::size_t length = 4; length < text.size() - 2; ++length) {
    EXPECT_NE(error_of(text.substr(0, length)), "no error") << "after " << length << " bytes";
  }
}

TEST_F(PlyCheckTest, SaysWhereTheDataEnd) {
  std::string const binary = binary_ply(cube(1), false);
  EXPECT_EQ(error_of(binary.substr(0, binary.size() - 1)),
            kBroken + "row 11 of the 12 of element 'face'");
  EXPECT_EQ(error_of(test::ply_header("ascii", cube(1)) + "0 0 0\n"),
            kBroken + "row 1 of the 8 of element 'vertex'");
  EXPECT_EQ(error_of(test::ply_header("ascii", cube(1)) + "0 0 zero\n"),
            kBroken + "row 0 of the 8 of element 'vertex'");
}

TEST_F(PlyCheckTest, CountsOfItemsAreNotBelieved) {
  std::string const head = "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list ";
  EXPECT_EQ(error_of(head + "int double a\nend_header\n\1" + std::string(10, '\0')),
            kBroken + "row 0 of the 1 of element 'face'");
  EXPECT_EQ(error_of(head + "int double a\nend_header\n\1" + std::string(11, '\0')), "no error");
  EXPECT_EQ(error_of(head + "char char a\nend_header\n\xFF" + std::string(300, '\0')),
            kBroken + "row 0 of the 1 of element 'face'");
  EXPECT_EQ(error_of(head + "uchar char a\nend_header\n\xFF" + std::string(300, '\0')), "no error");
  EXPECT_EQ(error_of(head + "float char a\nend_header\n"),
            "PLY header counts the items of a list in 'float'");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement face 1\nproperty list int int a\n"
                     "end_header\n-1 0\n"),
            kBroken + "row 0 of the 1 of element 'face'");
}

TEST_F(PlyCheckTest, DamagedHeadersSayWhy) {
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\n"), "PLY header has no end; is the file cut short?");
  EXPECT_EQ(error_of("ply\nformat text 1.0\n"), "PLY header names the unknown format 'text'");
  EXPECT_EQ(error_of("ply\nelement vertex -1\n"),
            "PLY header does not say how many elements there are: element vertex -1");
  EXPECT_EQ(error_of("ply\nproperty float x\n"), "PLY header has a property of no element");
  EXPECT_EQ(error_of("ply\nelement vertex 1\nproperty real x\n"),
            "PLY header names the unknown type 'real'");
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n"),
            "PLY header gives the element 'vertex' no properties");
}

}  // namespace
}  // namespace credo
