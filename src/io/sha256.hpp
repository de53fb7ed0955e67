#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace credo {

/// The SHA-256 of these bytes, as 64 small hexadecimal digits. About a millisecond a megabyte where
/// the processor has instructions for it.
std::string sha256_of(std::span<unsigned char const> bytes);
/// The same of a file, read piece by piece. Throws InputError where it cannot be read.
std::string sha256_of_file(std::filesystem::path const& path);

}  // namespace credo
