#include "io/ply_check.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace credo {
namespace {

enum class Format : std::uint8_t { kAscii, kBinaryLittle, kBinaryBig };
enum class Kind : std::uint8_t { kSigned, kUnsigned, kFloat };

struct Type {
  std::size_t bytes;
  Kind kind;
};

struct Property {
  Type type;
  /// Of the number before the items; a single value has none.
  std::optional<Type> list_count;
};

struct Element {
  std::string name;
  std::uint64_t rows;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::kAscii;
  std::vector<Element> elements;
};

Type type_named(std::string const& name) {
  static std::map<std::string, Type, std::less<>> const types = {
      {"char", {1, Kind::kSigned}},     {"int8", {1, Kind::kSigned}},
      {"uchar", {1, Kind::kUnsigned}},  {"uint8", {1, Kind::kUnsigned}},
      {"short", {2, Kind::kSigned}},    {"int16", {2, Kind::kSigned}},
      {"ushort", {2, Kind::kUnsigned}}, {"uint16", {2, Kind::kUnsigned}},
      {"int", {4, Kind::kSigned}},      {"int32", {4, Kind::kSigned}},
      {"uint", {4, Kind::kUnsigned}},   {"uint32", {4, Kind::kUnsigned}},
      {"float", {4, Kind::kFloat}},     {"float32", {4, Kind::kFloat}},
      {"double", {8, Kind::kFloat}},    {"float64", {8, Kind::kFloat}},
  };
  auto const found = types.find(name);
  if (found == types.end()) {
    throw std::invalid_argument("PLY header names the unknown type '" + name + "'");
  }
  return found->second;
}

Format format_named(std::string const& name) {
  if (name == "ascii") {
    return Format::kAscii;
  }
  if (name == "binary_little_endian") {
    return Format::kBinaryLittle;
  }
  if (name == "binary_big_endian") {
    return Format::kBinaryBig;
  }
  throw std::invalid_argument("PLY header names the unknown format '" + name + "'");
}

Property read_property(std::istringstream& words) {
  std::string type;
  words >> type;
  if (type != "list") {
    return {type_named(type), std::nullopt};
  }
  std::string count;
  words >> count >> type;
  Type const count_type = type_named(count);
  if (count_type.kind == Kind::kFloat) {
    throw std::invalid_argument("PLY header counts the items of a list in '" + count + "'");
  }
  return {type_named(type), count_type};
}

/// Reads on to the first byte of the data.
Header read_header(std::istream& file) {
  Header header;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "end_header") {
      return header;
    }
    if (word == "format") {
      words >> word;
      header.format = format_named(word);
    } else if (word == "element") {
      Element element{};
      std::int64_t rows = -1;
      if (!(words >> element.name >> rows) || rows < 0) {
        throw std::invalid_argument("PLY header does not say how many elements there are: " + line);
      }
      element.rows = static_cast<std::uint64_t>(rows);
      header.elements.push_back(element);
    } else if (word == "property") {
      if (header.elements.empty()) {
        throw std::invalid_argument("PLY header has a property of no element");
      }
      header.elements.back().properties.push_back(read_property(words));
    }
  }
  throw std::invalid_argument("PLY header has no end; is the file cut short?");
}

/// The numbers of a row in text, which is a line.
class TextRows {
public:
  explicit TextRows(std::istream& file) : file_(file) {}

  /// Whether the next row holds these properties.
  bool next(std::vector<Property> const& properties) {
    std::string line;
    if (!std::getline(file_, line)) {
      return false;
    }
    std::istringstream words(line);
    auto const holds = [&](Property const& property) {
      std::uint64_t count = 1;
      if (property.list_count && !(words >> count)) {
        return false;
      }
      std::string word;
      for (; count > 0 && words >> word && is_number(word); --count) {
      }
      return count == 0;
    };
    return std::all_of(properties.begin(), properties.end(), holds);
  }

private:
  static bool is_number(std::string const& word) {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    return end == word.c_str() + word.size();
  }

  std::istream& file_;
};

class BinaryRows {
public:
  BinaryRows(std::string_view data, bool big_endian) : rest_(data), big_endian_(big_endian) {}

  /// Whether the next row holds these properties.
  bool next(std::vector<Property> const& properties) {
    return std::all_of(properties.begin(), properties.end(), [this](Property const& property) {
      if (!property.list_count) {
        return skip(1, property.type.bytes);
      }
      std::optional<std::uint64_t> const count = read_count(*property.list_count);
      return count && skip(*count, property.type.bytes);
    });
  }

private:
  bool skip(std::uint64_t count, std::size_t bytes) {
    if (count > rest_.size() / bytes) {
      return false;
    }
    rest_.remove_prefix(count * bytes);
    return true;
  }

  /// None for a negative number or at the end of the data.
  std::optional<std::uint64_t> read_count(Type type) {
    std::string_view const bytes = rest_.substr(0, type.bytes);
    if (!skip(1, type.bytes)) {
      return std::nullopt;
    }
    std::string high_first(bytes);
    if (!big_endian_) {
      std::reverse(high_first.begin(), high_first.end());
    }
    std::uint64_t value = 0;
    for (char const byte : high_first) {
      value = value << 8U | static_cast<std::uint8_t>(byte);
    }
    bool const negative = type.kind == Kind::kSigned && (high_first[0] & 0x80) != 0;
    return negative ? std::nullopt : std::optional(value);
  }

  std::string_view rest_;
  bool big_endian_;
};

template <typename Rows>
void check_rows(Rows rows, std::vector<Element> const& elements) {
  for (Element const& element : elements) {
    if (element.properties.empty()) {
      throw std::invalid_argument("PLY header gives the element '" + element.name +
                                  "' no properties");
    }
    for (std::uint64_t row = 0; row < element.rows; ++row) {
      if (!rows.next(element.properties)) {
        throw std::invalid_argument(
            "PLY data are damaged or cut short in row " + std::to_string(row) + " of the " +
            std::to_string(element.rows) + " of element '" + element.name + "'");
      }
    }
  }
}

bool is_ply(std::istream& file) {
  std::string line;
  std::getline(file, line);
  std::string word;
  std::istringstream(line) >> word;
  return word == "ply" || word == "PLY";
}

}  // namespace

void check_ply(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  if (!is_ply(file)) {
    return;
  }
  try {
    Header const header = read_header(file);
    if (header.format == Format::kAscii) {
      check_rows(TextRows(file), header.elements);
    } else {
      std::string const data(std::istreambuf_iterator<char>(file), {});
      check_rows(BinaryRows(data, header.format == Format::kBinaryBig), header.elements);
    }
  } catch (std::exception const& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace credo
