#pragma once

#include <filesystem>

#include "core/object_model.hpp"

namespace credo {

/// Writes a mesh as a binary PLY file, metres. Throws InputError where it cannot be written.
void write_ply(std::filesystem::path const& path, TriangleMesh const& mesh);

}  // namespace credo
