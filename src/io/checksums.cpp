#include "io/checksums.hpp"

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "io/sha256.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigits = 64;

/// 64 hexadecimal digits, a space, a space or a star, a name.
bool is_checksum_line(std::string const& line) {
  auto const is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return line.size() > kDigits + 2 && line[kDigits] == ' ' &&
         (line[kDigits + 1] == ' ' || line[kDigits + 1] == '*') &&
         std::all_of(line.begin(), line.begin() + kDigits, is_hex);
}

}  // namespace

std::string checksum_line(std::string const& sha256, std::string const& name) {
  return sha256 + "  " + name;
}

Checksums::Checksums(fs::path const& list) : list_(list) {
  std::error_code error;
  if (!fs::exists(list, error)) {
    return;
  }
  std::ifstream file(list);
  if (!file) {
    throw InputError(list.string() + ": cannot be read");
  }
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (file.eof()) {
      break;  // cut short
    }
    if (!is_checksum_line(line)) {
      throw InputError(list.string() + ":" + std::to_string(number) +
                       ": is no line of sha256sum: the list is damaged; restore it, or remove it "
                       "to read without verifying");
    }
    fs::path const name = line.substr(kDigits + 2);
    sums_[(list.parent_path() / name).lexically_normal()] = line.substr(0, kDigits);
  }
}

bool Checksums::lists(fs::path const& file) const {
  return sums_.contains(file.lexically_normal());
}

Checksums::Verdict Checksums::of(fs::path const& file, std::span<unsigned char const> bytes) const {
  auto const found = sums_.find(file.lexically_normal());
  if (found == sums_.end()) {
    return Verdict::kUnlisted;
  }
  return sha256_of(bytes) == found->second ? Verdict::kSame : Verdict::kDamaged;
}

void Checksums::check(fs::path const& file) const {
  auto const found = sums_.find(file.lexically_normal());
  if (found == sums_.end()) {
    return;
  }
  if (!fs::exists(file)) {
    throw InputError(file.string() + ": is listed in " + list_.filename().string() +
                     ", but not there: restore it from a copy");
  }
  if (sha256_of_file(file) != found->second) {
    throw InputError(file.string() +
                     ": is damaged, or was changed: it does not match its checksum in " +
                     list_.filename().string() +
                     "; restore it from a copy, or remove its line there to read it as it is");
  }
}

}  // namespace credo
