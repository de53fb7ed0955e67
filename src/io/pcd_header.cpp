#include "io/pcd_header.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSidePx = 8192;
constexpr std::size_t kMaxFieldCount = 4096;
/// Far more than any header has: what is longer is no header.
constexpr int kMaxHeaderLines = 64;

[[noreturn]] void fail(fs::path const& path, std::string const& what) {
  throw InputError(path.string() + ": " + what);
}

std::vector<std::size_t> counts_in(std::istringstream& words) {
  std::vector<std::size_t> counts;
  for (std::size_t count = 0; words >> count;) {
    counts.push_back(count);
  }
  return counts;
}

/// Fills in `bytes_per_point` and `values_per_point`.
void add_fields(PcdHeader& header, std::vector<std::size_t> const& sizes,
                std::vector<std::size_t> const& counts, fs::path const& path) {
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    // COUNT may be left out, and is then one each.
    std::size_t const count = counts.empty() ? 1 : counts[i];
    if (sizes[i] < 1 || sizes[i] > 8 || count < 1 || count > kMaxFieldCount) {
      fail(path, "damaged PCD header: a field of " + std::to_string(count) + " times " +
                     std::to_string(sizes[i]) + " bytes");
    }
    header.values_per_point += count;
    header.bytes_per_point += count * sizes[i];
  }
}

PcdHeader read_header(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  PcdHeader header;
  std::size_t fields = 0;
  std::vector<std::size_t> sizes;
  std::vector<std::size_t> counts;
  std::string kind;
  std::string line;
  for (int i = 0; i < kMaxHeaderLines && kind.empty() && std::getline(file, line); ++i) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "FIELDS") {
      for (std::string name; words >> name;) {
        ++fields;
      }
    } else if (key == "SIZE") {
      sizes = counts_in(words);
    } else if (key == "COUNT") {
      counts = counts_in(words);
    } else if (key == "WIDTH") {
      words >> header.width;
    } else if (key == "HEIGHT") {
      words >> header.height;
    } else if (key == "POINTS") {
      words >> header.points;
    } else if (key == "DATA") {
      words >> kind;
    }
  }
  if (fields == 0 || header.width == 0 || header.height == 0 || kind.empty()) {
    fail(path, "not a PCD file: its header needs FIELDS, WIDTH, HEIGHT and DATA");
  }
  if (sizes.size() != fields || (!counts.empty() && counts.size() != fields)) {
    fail(path, "damaged PCD header: FIELDS, SIZE and COUNT differ in length");
  }
  add_fields(header, sizes, counts, path);
  if (kind != "ascii" && kind != "binary" && kind != "binary_compressed") {
    fail(path, "damaged PCD header: DATA " + kind);
  }
  header.data = kind == "ascii"    ? PcdData::kAscii
                : kind == "binary" ? PcdData::kBinary
                                   : PcdData::kCompressed;
  if (file.eof()) {
    fail(path, "cut short, ends with its header");
  }
  header.data_start = static_cast<std::size_t>(file.tellg());
  return header;
}

std::string size_of(PcdHeader const& header) {
  return std::to_string(header.width) + "x" + std::to_string(header.height);
}

void check_organised(PcdHeader const& header, fs::path const& path) {
  if (header.width < 2 || header.height < 2) {
    fail(path, "not organised (" + size_of(header) + "): an image of points is needed");
  }
  if (header.width > kMaxSidePx || header.height > kMaxSidePx) {
    fail(path, "damaged PCD header: claims " + size_of(header) + " points");
  }
}

void check_size(PcdHeader const& header, fs::path const& path) {
  std::string const size = size_of(header);
  constexpr std::size_t kMostPoints = kMaxSidePx * kMaxSidePx;
  if (header.width > kMostPoints || header.height > kMostPoints / header.width) {
    fail(path, "damaged PCD header: claims " + size + " points");
  }
  if (header.points != header.width * header.height) {
    fail(path, "damaged PCD header: " + std::to_string(header.points) + " POINTS for " + size);
  }
}

/// PCL takes a word that is no number for 0, and leaves a point that lacks values at 0.
void check_ascii_point(std::string const& line, std::size_t point, PcdHeader const& header,
                       fs::path const& path) {
  std::istringstream words(line);
  std::size_t values = 0;
  for (std::string word; words >> word; ++values) {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    if (end != word.c_str() + word.size()) {
      fail(path, "damaged PCD data: '" + word + "' is no number");
    }
  }
  if (values != header.values_per_point) {
    fail(path, "damaged PCD data: point " + std::to_string(point) + " has " +
                   std::to_string(values) + " values, " + std::to_string(header.values_per_point) +
                   " expected");
  }
}

void check_ascii(PcdHeader const& header, fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(header.data_start));
  std::size_t points = 0;
  for (std::string line; points < header.points && std::getline(file, line);) {
    if (file.eof() && points + 1 < header.points) {
      break;  // cut within this line
    }
    if (line.find_first_not_of(" \t\r") != std::string::npos) {
      check_ascii_point(line, points++, header, path);
    }
  }
  if (points < header.points) {
    fail(path, "cut short, has " + std::to_string(points) + " of " + std::to_string(header.points) +
                   " points");
  }
}

/// Holds the length of the file against the header: a file may be cut by a full disk.
void check_complete(PcdHeader const& header, fs::path const& path) {
  if (header.data == PcdData::kAscii) {
    check_ascii(header, path);
    return;
  }
  std::error_code error;
  auto const size = fs::file_size(path, error);
  std::size_t const bytes = header.points * header.bytes_per_point;
  std::size_t needed = header.data_start;
  if (header.data == PcdData::kBinary) {
    needed += bytes;
  } else {
    std::array<std::uint32_t, 2> lengths{};  // compressed, uncompressed
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(header.data_start));
    file.read(reinterpret_cast<char*>(lengths.data()), sizeof lengths);
    if (file && lengths[1] != bytes) {
      fail(path, "damaged PCD data: unpacks to " + std::to_string(lengths[1]) + " bytes, " +
                     std::to_string(bytes) + " expected");
    }
    needed += sizeof lengths + (file ? lengths[0] : 0);
  }
  if (error || size < needed) {
    fail(path, "cut short, has " + std::to_string(error ? 0 : size) + " of " +
                   std::to_string(needed) + " bytes");
  }
}

PcdHeader header_of_file(fs::path const& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    fail(path, "no such file");
  }
  return read_header(path);
}

}  // namespace

PcdHeader read_any_pcd_header(fs::path const& path) {
  PcdHeader const header = header_of_file(path);
  check_size(header, path);
  check_complete(header, path);
  return header;
}

PcdHeader read_pcd_header(fs::path const& path) {
  check_organised(header_of_file(path), path);
  return read_any_pcd_header(path);
}

}  // namespace credo
