#include "eval/existence_scorer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace credo {

void ExistenceScorer::add(double probability, bool is_there) {
  auto const tenth = static_cast<std::size_t>(probability * static_cast<double>(bins_.size()));
  Bin& bin = bins_.at(std::min(tenth, bins_.size() - 1));
  ++bin.count;
  bin.probability_sum += probability;
  bin.there += is_there ? 1 : 0;
  double const error = probability - (is_there ? 1.0 : 0.0);
  squared_error_ += error * error;
}

std::optional<ExistenceScores> ExistenceScorer::scores() const {
  ExistenceScores scores;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    Bin const& bin = bins_.at(i);
    count += bin.count;
    if (bin.count == 0) {
      continue;
    }
    auto const n = static_cast<double>(bin.count);
    scores.reliability.at(i) = {bin.count, bin.probability_sum / n,
                                static_cast<double>(bin.there) / n};
    scores.ece += std::abs(bin.probability_sum - static_cast<double>(bin.there));
  }
  if (count == 0) {
    return std::nullopt;
  }
  scores.ece /= static_cast<double>(count);
  scores.brier = squared_error_ / static_cast<double>(count);
  return scores;
}

}  // namespace credo
