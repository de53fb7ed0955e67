#pragma once

#include <filesystem>
#include <string>

namespace credo {

/// The libOpenNI2 that this process runs with.
struct OpenniLibraryFile {
  /// As the loader found it, links not followed: OpenNI2 looks for its drivers beside that.
  std::filesystem::path path;
  /// "2.2.0.33".
  std::string version;
};

OpenniLibraryFile openni_library_file();

}  // namespace credo
