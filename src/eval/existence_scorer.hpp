#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/scores.hpp"

namespace credo {

/// Whether what is believed with probability p is there in a share p of all cases.
class ExistenceScorer {
public:
  /// One claim of one frame.
  void add(double probability, bool is_there);
  /// None without a claim.
  [[nodiscard]] std::optional<ExistenceScores> scores() const;

private:
  struct Bin {
    std::uint64_t count = 0;
    double probability_sum = 0.0;
    std::uint64_t there = 0;
  };
  std::array<Bin, 10> bins_;
  double squared_error_ = 0.0;
};

}  // namespace credo
