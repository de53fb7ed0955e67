#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace credo {

/// The list in a recording's folder: lines of `sha256sum`.
inline constexpr char const* kChecksumFile = "SHA256SUMS";

/// A line of `sha256sum` without its end.
std::string checksum_line(std::string const& sha256, std::string const& name);

/// What a list of `sha256sum` says of files; empty where there is no list. What it does not name is
/// not verified.
class Checksums {
public:
  enum class Verdict : std::uint8_t { kUnlisted, kSame, kDamaged };

  Checksums() = default;
  /// Names in the list count from its folder. A last line that was cut short is passed over. Throws
  /// InputError where a line is none of `sha256sum`, or the list is there and cannot be read.
  explicit Checksums(std::filesystem::path const& list);

  [[nodiscard]] bool lists(std::filesystem::path const& file) const;
  [[nodiscard]] Verdict of(std::filesystem::path const& file,
                           std::span<unsigned char const> bytes) const;
  /// Throws InputError where the file is listed and does not match, or is not there.
  void check(std::filesystem::path const& file) const;
  /// By path, the list's folder before each.
  [[nodiscard]] std::map<std::filesystem::path, std::string> const& all() const { return sums_; }

private:
  std::filesystem::path list_;
  std::map<std::filesystem::path, std::string> sums_;
};

}  // namespace credo
