#pragma once

#include <filesystem>

namespace credo {

/// FILE.oni.sha256, beside the recording: one line of `sha256sum`.
std::filesystem::path oni_checksum_file(std::filesystem::path const& recording);

/// Writes it. Throws InputError where that fails.
void write_oni_checksum(std::filesystem::path const& recording);

/// Where there is such a file: throws InputError, one line, unless the recording is as it says.
/// Without one, nothing is verified. Reads all of the recording: about 1 to 2 s a gigabyte.
void check_oni_checksum(std::filesystem::path const& recording);

}  // namespace credo
