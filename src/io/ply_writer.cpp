#include "io/ply_writer.hpp"

#include <bit>
#include <cstdint>
#include <fstream>

#include "core/error.hpp"

namespace credo {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says little endian");

template <typename T>
void put(std::ofstream& file, T const* values, std::size_t count) {
  file.write(reinterpret_cast<char const*>(values),
             static_cast<std::streamsize>(count * sizeof(T)));
}

}  // namespace

void write_ply(std::filesystem::path const& path, TriangleMesh const& mesh) {
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    put(file, vertex.data(), 3);
  }
  constexpr std::uint8_t kCorners = 3;
  for (auto const& triangle : mesh.triangles) {
    put(file, &kCorners, 1);
    put(file, triangle.data(), triangle.size());
  }
  if (!file.flush()) {
    throw InputError(path.string() + ": cannot be written");
  }
}

}  // namespace credo
