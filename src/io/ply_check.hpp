#pragma once

#include <filesystem>

namespace credo {

/// Throws InputError for a PLY file that holds less than its header promises, or whose header is
/// damaged: assimp crashes on such files, reads them for ever, or takes what is there for all. Any
/// other file passes.
void check_ply(std::filesystem::path const& path);

}  // namespace credo
