#include "io/recorded_detections.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace credo {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(std::string const& where, std::string const& reason) {
  throw std::invalid_argument(where + (where.empty() ? "" : ": ") + reason);
}

/// A value and where in its line it stands, such as detections[2].covariance.
struct Value {
  Json const& json;
  std::string where;

  [[nodiscard]] Value at(std::string const& key) const {
    std::string const name = where.empty() ? key : where + "." + key;
    auto const found = json.find(key);
    if (found == json.end()) {
      refuse(name, "is missing");
    }
    return {*found, name};
  }
  [[nodiscard]] bool has(std::string const& key) const { return json.contains(key); }

  /// Refuses what is no object, and keys that are not known.
  void must_be_object(std::initializer_list<char const*> known) const {
    if (!json.is_object()) {
      refuse(where, "must be an object with the keys " + listed(known));
    }
    for (auto const& [key, unused] : json.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        refuse(where, "unknown key '" + key + "'; the keys are " + listed(known));
      }
    }
  }

private:
  static std::string listed(std::initializer_list<char const*> names) {
    std::string text;
    for (char const* name : names) {
      text += (text.empty() ? "" : ", ") + std::string(name);
    }
    return text;
  }
};

double number_of(Value const& value) {
  if (!value.json.is_number()) {
    refuse(value.where, "must be a number");
  }
  return value.json.get<double>();
}

template <std::size_t count>
std::array<double, count> numbers_of(Value const& value) {
  std::string const must = "must be " + std::to_string(count) + " numbers";
  if (!value.json.is_array()) {
    refuse(value.where, must);
  }
  if (value.json.size() != count) {
    refuse(value.where, must + ", has " + std::to_string(value.json.size()));
  }
  std::array<double, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    numbers.at(i) = number_of({value.json[i], value.where + "[" + std::to_string(i) + "]"});
  }
  return numbers;
}

FrameIndex frame_of(Value const& value) {
  // The parser takes every whole number that is not negative for an unsigned one.
  if (!value.json.is_number_unsigned() ||
      value.json.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max()) {
    refuse(value.where, "must be a whole number, 0 or above");
  }
  return FrameIndex{value.json.get<std::int64_t>()};
}

std::string type_of(Value const& value) {
  if (!value.json.is_string() || value.json.get_ref<std::string const&>().empty()) {
    refuse(value.where, "must be a text that is not empty");
  }
  return value.json.get<std::string>();
}

Eigen::Quaterniond orientation_of(Value const& value) {
  auto const xyzw = numbers_of<4>(value);
  Eigen::Quaterniond orientation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  double const length = orientation.norm();
  if (!(std::abs(length - 1.0) <= 1e-2)) {
    std::ostringstream text;
    text << "must be of length 1, has " << length;
    refuse(value.where, text.str());
  }
  return orientation;
}

/// Beyond these, sums and differences of poses have no digits left.
constexpr double kMaxPosition_m = 1e4;
constexpr double kMinDeviation = 1e-6;
constexpr double kMaxDeviation = 1e3;

Eigen::Vector3d position_of(Value const& value) {
  Eigen::Vector3d position(numbers_of<3>(value).data());
  if (position.cwiseAbs().maxCoeff() > kMaxPosition_m) {
    refuse(value.where, "must be within 10000 m");
  }
  return position;
}

Matrix6d covariance_of(Value const& value) {
  auto const numbers = numbers_of<36>(value);
  Matrix6d const read =
      Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor> const>(numbers.data());
  Matrix6d covariance = 0.5 * (read + read.transpose());
  double const off = (read - covariance).cwiseAbs().maxCoeff();
  if (!(off <= 1e-6 * read.cwiseAbs().maxCoeff()) ||
      covariance.llt().info() != Eigen::ComputationInfo::Success) {
    refuse(value.where, "must be symmetric and positive definite");
  }
  auto const variances = covariance.diagonal().array();
  // A little less than the square, which may be rounded.
  if (variances.minCoeff() < 0.999 * kMinDeviation * kMinDeviation ||
      variances.maxCoeff() > kMaxDeviation * kMaxDeviation) {
    refuse(value.where, "must have standard deviations in [1e-6, 1000] m and rad");
  }
  return covariance;
}

double fraction_of(Value const& value) {
  double const fraction = number_of(value);
  if (fraction < 0.0 || fraction > 1.0) {
    refuse(value.where, "must be in [0, 1]");
  }
  return fraction;
}

Detection detection_of(Value const& value) {
  value.must_be_object(
      {"type", "position", "orientation_xyzw", "covariance", "score", "visible_fraction"});
  Detection detection;
  detection.type = type_of(value.at("type"));
  detection.pose_camera.mean =
      Se3(orientation_of(value.at("orientation_xyzw")), position_of(value.at("position")));
  detection.pose_camera.covariance = covariance_of(value.at("covariance"));
  detection.score = number_of(value.at("score"));
  if (value.has("visible_fraction")) {
    detection.visible_fraction = fraction_of(value.at("visible_fraction"));
  }
  return detection;
}

std::pair<FrameIndex, std::vector<Detection>> frame_in(Value const& line) {
  line.must_be_object({"frame", "detections"});
  FrameIndex const frame = frame_of(line.at("frame"));
  Value const list = line.at("detections");
  if (!list.json.is_array()) {
    refuse(list.where, "must be a list");
  }
  std::vector<Detection> detections;
  for (std::size_t i = 0; i < list.json.size(); ++i) {
    detections.push_back(detection_of({list.json[i], list.where + "[" + std::to_string(i) + "]"}));
  }
  return {frame, std::move(detections)};
}

Json parsed(std::string const& line) {
  try {
    return Json::parse(line);
  } catch (Json::parse_error const& error) {
    throw std::invalid_argument("is not JSON from character " + std::to_string(error.byte) + " on");
  } catch (Json::out_of_range const&) {
    throw std::invalid_argument("has a number that is too large");
  }
}

}  // namespace

RecordedDetector::RecordedDetector(std::filesystem::path const& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError(path.string() + ": is a folder; recorded detections are a file");
  }
  std::ifstream file(path);
  if (!file) {
    throw InputError(path.string() + ": recorded detections cannot be read");
  }
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    try {
      auto [frame, detections] = frame_in({parsed(line), ""});
      if (!by_frame_.try_emplace(frame, std::move(detections)).second) {
        refuse("frame", std::to_string(number(frame)) + " has a line already");
      }
    } catch (std::exception const& error) {
      throw InputError(path.string() + ":" + std::to_string(line_number) + ": " + error.what());
    }
  }
}

std::vector<Detection> RecordedDetector::detect(Frame const& frame,
                                                std::vector<DetectionRequest> const& /*requests*/) {
  auto const found = by_frame_.find(frame.index);
  return found != by_frame_.end() ? found->second : std::vector<Detection>{};
}

}  // namespace credo
