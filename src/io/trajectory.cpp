#include "io/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "core/error.hpp"

namespace credo {
namespace {

constexpr std::int64_t kMaxBracketNs = 100'000'000;
constexpr std::int64_t kMaxNearestNs = 20'000'000;
constexpr double kMaxStampS = 9e9;

/// The numbers of a text; throws std::invalid_argument at the first word that is none. NaN and inf
/// are numbers here: what they are part of refuses them with a better text.
std::vector<double> numbers_in(std::string const& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    double const value = std::strtod(word.c_str(), &end);
    if (end != word.c_str() + word.size()) {
      throw std::invalid_argument("'" + word + "' is no number");
    }
    numbers.push_back(value);
  }
  return numbers;
}

Se3 from_rows(std::vector<double> const& numbers) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = numbers[i];
  }
  return Se3::from_matrix(matrix);
}

}  // namespace

std::optional<std::int64_t> stamp_from_seconds(double stamp_s) {
  if (!(std::abs(stamp_s) <= kMaxStampS)) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(std::llround(stamp_s * 1e9));
}

std::optional<std::int64_t> stamp_from_text(std::string const& word) {
  std::size_t const point = std::min(word.find('.'), word.size());
  std::string const whole = word.substr(0, point);
  std::string part = word.substr(std::min(point + 1, word.size()));
  auto const digits = [](std::string const& text) {
    return text.find_first_not_of("0123456789") == std::string::npos;
  };
  if (!whole.empty() && whole.size() <= 9 + 1 && part.size() <= 9 && digits(whole) &&
      digits(part) && std::stoll(whole) < static_cast<std::int64_t>(kMaxStampS)) {
    part.append(9 - part.size(), '0');
    return std::stoll(whole) * 1'000'000'000 + std::stoll(part);
  }
  char* end = nullptr;
  double const stamp_s = std::strtod(word.c_str(), &end);
  return word.empty() || *end != '\0' ? std::nullopt : stamp_from_seconds(stamp_s);
}

Se3 read_pose(std::filesystem::path const& path) {
  std::ifstream file(path);
  if (!file) {
    throw InputError(path.string() + ": pose cannot be read");
  }
  std::ostringstream text;
  text << file.rdbuf();
  try {
    std::vector<double> const numbers = numbers_in(text.str());
    if (numbers.size() != 16) {
      throw std::invalid_argument("needs 16 numbers, has " + std::to_string(numbers.size()));
    }
    return from_rows(numbers);
  } catch (std::exception const& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

Trajectory::Trajectory(std::filesystem::path const& path, LastLine last) {
  std::ifstream file(path);
  if (!file) {
    throw InputError(path.string() + ": trajectory cannot be read");
  }
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    if (last == LastLine::kDropTorn && file.eof()) {
      break;
    }
    try {
      std::vector<double> const numbers = numbers_in(line.substr(0, line.find('#')));
      if (!numbers.empty()) {
        add_line(numbers, line);
      }
    } catch (std::exception const& error) {
      throw InputError(path.string() + ":" + std::to_string(line_number) + ": " + error.what());
    }
  }
  if (poses_.empty()) {
    throw InputError(path.string() + ": trajectory has no poses");
  }
}

void Trajectory::add_line(std::vector<double> const& numbers, std::string const& line) {
  bool const by_stamp = numbers.size() == 8;
  if (!by_stamp && numbers.size() != 12 && numbers.size() != 16) {
    throw std::invalid_argument("needs 8 (stamp, position, quaternion), 12 or 16 numbers, has " +
                                std::to_string(numbers.size()));
  }
  if (!poses_.empty() && by_stamp != by_stamp_) {
    throw std::invalid_argument("mixes poses by stamp and poses by frame");
  }
  by_stamp_ = by_stamp;
  if (!by_stamp) {
    poses_.push_back(from_rows(numbers));
    return;
  }
  for (double const value : numbers) {
    if (!std::isfinite(value)) {
      throw std::invalid_argument("pose has a number that is not finite");
    }
  }
  std::istringstream words(line);
  std::string stamp;
  words >> stamp;
  std::optional<std::int64_t> const stamp_ns = stamp_from_text(stamp);
  if (!stamp_ns) {
    throw std::invalid_argument("stamp is no time in seconds");
  }
  if (!stamps_ns_.empty() && *stamp_ns <= stamps_ns_.back()) {
    throw std::invalid_argument("stamp does not rise");
  }
  Eigen::Quaterniond const rotation(numbers[7], numbers[4], numbers[5], numbers[6]);
  if (std::abs(rotation.norm() - 1.0) > 1e-2) {
    throw std::invalid_argument("quaternion is not of unit length");
  }
  poses_.emplace_back(rotation, Eigen::Vector3d(numbers[1], numbers[2], numbers[3]));
  stamps_ns_.push_back(*stamp_ns);
}

std::optional<Se3> Trajectory::at(FrameIndex index, std::int64_t stamp_ns) const {
  if (by_stamp_) {
    return at_stamp(stamp_ns);
  }
  auto const i = static_cast<std::size_t>(number(index));
  return i < poses_.size() ? std::optional<Se3>(poses_[i]) : std::nullopt;
}

std::optional<Se3> Trajectory::at_stamp(std::int64_t stamp_ns) const {
  auto const after = static_cast<std::size_t>(
      std::lower_bound(stamps_ns_.begin(), stamps_ns_.end(), stamp_ns) - stamps_ns_.begin());
  if (after < stamps_ns_.size() && stamps_ns_[after] == stamp_ns) {
    return poses_[after];
  }
  if (after > 0 && after < stamps_ns_.size()) {
    std::int64_t const since = stamp_ns - stamps_ns_[after - 1];
    std::int64_t const until = stamps_ns_[after] - stamp_ns;
    if (since <= kMaxBracketNs && until <= kMaxBracketNs) {
      double const share = static_cast<double>(since) / static_cast<double>(since + until);
      Se3 const& a = poses_[after - 1];
      return boxplus(a, share * boxminus(poses_[after], a));
    }
    if (since <= kMaxNearestNs) {
      return poses_[after - 1];
    }
  }
  if (after < stamps_ns_.size() && stamps_ns_[after] - stamp_ns <= kMaxNearestNs) {
    return poses_[after];
  }
  if (after == stamps_ns_.size() && stamp_ns - stamps_ns_.back() <= kMaxNearestNs) {
    return poses_.back();
  }
  return std::nullopt;
}

}  // namespace credo
