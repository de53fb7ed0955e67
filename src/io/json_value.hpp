#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/frame.hpp"

namespace credo {

/// A value of a JSON text that others wrote, and where in it it stands, such as
/// detections[2].covariance. What is not as it must be throws std::invalid_argument that says so.
struct JsonValue {
  nlohmann::json const& json;
  std::string where;

  [[nodiscard]] JsonValue at(std::string const& key) const;
  [[nodiscard]] bool has(std::string const& key) const { return json.contains(key); }
  /// Refuses what is no object, and keys that are not known.
  void must_be_object(std::initializer_list<char const*> known) const;
  [[noreturn]] void refuse(std::string const& reason) const;

  [[nodiscard]] double number() const;
  /// In [0, 1].
  [[nodiscard]] double fraction() const;
  /// A whole number from 0 to `max`.
  [[nodiscard]] std::uint64_t count(std::uint64_t max) const;
  /// A whole number; negative, too.
  [[nodiscard]] std::int64_t integer() const;
  [[nodiscard]] bool flag() const;
  /// Not empty.
  [[nodiscard]] std::string text() const;
  template <std::size_t count>
  [[nodiscard]] std::array<double, count> numbers() const;
  /// Three numbers within 10 km: beyond, sums and differences of poses have no digits left.
  [[nodiscard]] Eigen::Vector3d position() const;
  /// Three numbers.
  [[nodiscard]] Eigen::Vector3d vector() const { return Eigen::Vector3d(numbers<3>().data()); }
  /// Sixteen numbers, row by row.
  [[nodiscard]] Eigen::Matrix4d matrix() const;
  /// Two points, each of two numbers.
  [[nodiscard]] std::array<Eigen::Vector2d, 2> segment() const;
  /// A frame's number.
  [[nodiscard]] FrameIndex frame() const;
  /// Four numbers x y z w, of length 1 within a hundredth.
  [[nodiscard]] Eigen::Quaterniond orientation() const;
  /// Calls `each` for every element of a list.
  void for_each(std::function<void(JsonValue const&)> const& each) const;
};

/// Calls `each` for every line of a file of JSON lines; empty ones are passed over. Whatever it
/// throws, and text that is not JSON, becomes an InputError that begins with FILE:LINE. `what` is
/// for a file that cannot be read: "recorded detections".
void for_each_json_line(std::filesystem::path const& path, std::string const& what,
                        std::function<void(JsonValue const&)> const& each);

/// Calls `read` with the value of a JSON file that people write; comments (//) are passed over.
/// Whatever it throws becomes an InputError that begins with the file's name, and text that is not
/// JSON one that begins with FILE:LINE:COLUMN. `what` is for a file that cannot be read.
void read_json_file(std::filesystem::path const& path, std::string const& what,
                    std::function<void(JsonValue const&)> const& read);

/// What `read` makes of each line of a file of JSON lines, in order; each has a `frame`, and one
/// that does not come after the one before is refused.
template <typename Read>
auto read_frames(std::filesystem::path const& path, std::string const& what, Read const& read) {
  std::vector<decltype(read(std::declval<JsonValue const&>()))> frames;
  for_each_json_line(path, what, [&](JsonValue const& line) {
    auto frame = read(line);
    if (!frames.empty() && !(number(frame.frame) > number(frames.back().frame))) {
      line.at("frame").refuse("must come after " + std::to_string(number(frames.back().frame)));
    }
    frames.push_back(std::move(frame));
  });
  return frames;
}

template <std::size_t count>
std::array<double, count> JsonValue::numbers() const {
  std::string const must = "must be " + std::to_string(count) + " numbers";
  if (!json.is_array()) {
    refuse(must);
  }
  if (json.size() != count) {
    refuse(must + ", has " + std::to_string(json.size()));
  }
  std::array<double, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    numbers.at(i) = JsonValue{json[i], where + "[" + std::to_string(i) + "]"}.number();
  }
  return numbers;
}

}  // namespace credo
