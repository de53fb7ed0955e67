#include "io/appended_file.hpp"

#include <utility>

#include "core/error.hpp"

namespace credo {

AppendedFile::AppendedFile(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, std::ios::binary) {
  if (!file_) {
    throw InputError(path_.string() + ": cannot be written");
  }
}

void AppendedFile::append(std::string const& line) {
  file_ << line << '\n' << std::flush;
  if (!file_) {
    file_.close();
    std::error_code ignored;
    std::filesystem::resize_file(path_, size_bytes_, ignored);
    throw InputError(path_.string() + ": cannot be written: is the disk full?");
  }
  size_bytes_ += line.size() + 1;
}

}  // namespace credo
