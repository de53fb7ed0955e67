#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace credo::segments {

/// Numbers labels that have gone into others anew, from 1, in the order in which they are met, and
/// counts their pixels.
class Numbering {
public:
  /// `root` names for each label the one that it went into.
  explicit Numbering(std::vector<std::int32_t> root)
      : root_(std::move(root)), number_of_(root_.size(), 0) {}

  /// For so many pixels of a label; 0 stays 0 and is not counted.
  std::int32_t number(std::int32_t label, std::size_t pixels) {
    if (label == 0) {
      return 0;
    }
    auto const whole = static_cast<std::size_t>(root_[static_cast<std::size_t>(label)]);
    std::int32_t& number = number_of_[whole];
    if (number == 0) {
      pixel_counts_.push_back(0);
      number = static_cast<std::int32_t>(pixel_counts_.size());
    }
    pixel_counts_[static_cast<std::size_t>(number - 1)] += static_cast<std::uint32_t>(pixels);
    return number;
  }

  /// Of number i + 1.
  [[nodiscard]] std::vector<std::uint32_t> pixel_counts() && { return std::move(pixel_counts_); }

private:
  std::vector<std::int32_t> root_;
  std::vector<std::int32_t> number_of_;
  std::vector<std::uint32_t> pixel_counts_;
};

}  // namespace credo::segments
