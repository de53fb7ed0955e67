#include "openni/oni_checksum.hpp"

#include "core/error.hpp"
#include "io/appended_file.hpp"
#include "io/checksums.hpp"
#include "io/sha256.hpp"

namespace credo {

namespace fs = std::filesystem;

fs::path oni_checksum_file(fs::path const& recording) {
  return recording.string() + ".sha256";
}

void write_oni_checksum(fs::path const& recording) {
  AppendedFile(oni_checksum_file(recording))
      .append(checksum_line(sha256_of_file(recording), recording.filename().string()));
}

void check_oni_checksum(fs::path const& recording) {
  fs::path const list = oni_checksum_file(recording);
  if (!fs::exists(list)) {
    return;
  }
  Checksums const sums(list);
  if (!sums.lists(recording)) {
    throw InputError(list.string() + ": has no line for " + recording.filename().string() +
                     ": was the recording renamed? Write it anew with sha256sum, or remove it to "
                     "read without verifying");
  }
  sums.check(recording);
}

}  // namespace credo
