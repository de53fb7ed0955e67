#include "io/json_value.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "core/told_pose.hpp"

namespace credo {
namespace {

std::string listed(std::initializer_list<char const*> names) {
  std::string text;
  for (char const* name : names) {
    text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

/// `is_end`: the file ends with this line, and without a line's end.
nlohmann::json parsed(std::string const& line, bool is_end) {
  try {
    return nlohmann::json::parse(line);
  } catch (nlohmann::json::parse_error const& error) {
    bool const is_cut = is_end && error.byte > line.size();
    throw std::invalid_argument("is not JSON from character " + std::to_string(error.byte) + " on" +
                                (is_cut ? ": the file was cut short; without this line the rest "
                                          "can be read"
                                        : ""));
  } catch (nlohmann::json::out_of_range const&) {
    throw std::invalid_argument("has a number that is too large");
  }
}

std::ifstream opened(std::filesystem::path const& path, std::string const& what) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError(path.string() + ": is a folder; " + what + " are a file");
  }
  std::ifstream file(path);
  if (!file) {
    throw InputError(path.string() + ": " + what + " cannot be read");
  }
  return file;
}

/// LINE:COLUMN, from 1, of a text's byte, from 1.
std::string place_of(std::string const& text, std::size_t byte) {
  std::string const before = text.substr(0, byte > 0 ? byte - 1 : 0);
  auto const line = 1 + std::count(before.begin(), before.end(), '\n');
  std::size_t const start = before.rfind('\n') + 1;  // 0 where there is none
  return std::to_string(line) + ":" + std::to_string(before.size() - start + 1);
}

}  // namespace

void JsonValue::refuse(std::string const& reason) const {
  throw std::invalid_argument(where + (where.empty() ? "" : ": ") + reason);
}

JsonValue JsonValue::at(std::string const& key) const {
  std::string const name = where.empty() ? key : where + "." + key;
  auto const found = json.find(key);
  if (found == json.end()) {
    JsonValue{json, name}.refuse("is missing");
  }
  return {*found, name};
}

void JsonValue::must_be_object(std::initializer_list<char const*> known) const {
  if (!json.is_object()) {
    refuse("must be an object with the keys " + listed(known));
  }
  for (auto const& [key, unused] : json.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      refuse("unknown key '" + key + "'; the keys are " + listed(known));
    }
  }
}

double JsonValue::number() const {
  if (!json.is_number()) {
    refuse("must be a number");
  }
  return json.get<double>();
}

double JsonValue::fraction() const {
  double const value = number();
  if (value < 0.0 || value > 1.0) {
    refuse("must be in [0, 1]");
  }
  return value;
}

std::uint64_t JsonValue::count(std::uint64_t max) const {
  // The parser takes every whole number that is not negative for an unsigned one.
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > max) {
    refuse("must be a whole number, 0 or above");
  }
  return json.get<std::uint64_t>();
}

std::int64_t JsonValue::integer() const {
  if (!json.is_number_integer()) {
    refuse("must be a whole number");
  }
  return json.get<std::int64_t>();
}

bool JsonValue::flag() const {
  if (!json.is_boolean()) {
    refuse("must be true or false");
  }
  return json.get<bool>();
}

std::string JsonValue::text() const {
  if (!json.is_string() || json.get_ref<std::string const&>().empty()) {
    refuse("must be a text that is not empty");
  }
  return json.get<std::string>();
}

Eigen::Vector3d JsonValue::position() const {
  auto const xyz = numbers<3>();
  try {
    return told_position(Eigen::Vector3d(xyz.data()));
  } catch (std::invalid_argument const& error) {
    refuse(error.what());
  }
}

Eigen::Matrix4d JsonValue::matrix() const {
  auto const rows = numbers<16>();
  return Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor> const>(rows.data());
}

std::array<Eigen::Vector2d, 2> JsonValue::segment() const {
  std::vector<Eigen::Vector2d> ends;
  for_each([&](JsonValue const& end) { ends.emplace_back(end.numbers<2>().data()); });
  if (ends.size() != 2) {
    refuse("must be two points");
  }
  return {ends[0], ends[1]};
}

FrameIndex JsonValue::frame() const {
  return FrameIndex{static_cast<std::int64_t>(count(std::numeric_limits<std::int64_t>::max()))};
}

Eigen::Quaterniond JsonValue::orientation() const {
  auto const xyzw = numbers<4>();
  try {
    return told_orientation({xyzw[3], xyzw[0], xyzw[1], xyzw[2]});
  } catch (std::invalid_argument const& error) {
    refuse(error.what());
  }
}

void JsonValue::for_each(std::function<void(JsonValue const&)> const& each) const {
  if (!json.is_array()) {
    refuse("must be a list");
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    each({json[i], where + "[" + std::to_string(i) + "]"});
  }
}

void for_each_json_line(std::filesystem::path const& path, std::string const& what,
                        std::function<void(JsonValue const&)> const& each) {
  std::ifstream file = opened(path, what);
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    try {
      nlohmann::json const json = parsed(line, file.eof());
      each({json, ""});
    } catch (std::exception const& error) {
      throw InputError(path.string() + ":" + std::to_string(line_number) + ": " + error.what());
    }
  }
}

void read_json_file(std::filesystem::path const& path, std::string const& what,
                    std::function<void(JsonValue const&)> const& read) {
  std::ifstream file = opened(path, what);
  std::string const text(std::istreambuf_iterator<char>(file), {});
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text, nullptr, true, true);
  } catch (nlohmann::json::parse_error const& error) {
    throw InputError(path.string() + ":" + place_of(text, error.byte) +
                     ": is not JSON from here on");
  } catch (nlohmann::json::out_of_range const&) {
    throw InputError(path.string() + ": has a number that is too large");
  }
  try {
    read({json, ""});
  } catch (std::exception const& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace credo
