#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace credo {

/// A text file that grows by whole lines: who looks at it, or is left with it, finds no torn one.
class AppendedFile {
public:
  /// Makes the file, empty. Throws InputError where it cannot.
  explicit AppendedFile(std::filesystem::path path);

  /// Hands the line to the system. Throws InputError where that fails; what a full disk took of the
  /// line is then cut off again.
  void append(std::string const& line);

  [[nodiscard]] std::filesystem::path const& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::ofstream file_;
  std::uint64_t size_bytes_ = 0;
};

}  // namespace credo
