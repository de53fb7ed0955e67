#pragma once

#include <string>
#include <vector>

#include "eval/detection_scorer.hpp"

namespace credo {

/// A method's scores and what they cost.
struct MethodResult {
  std::string method;
  DetectionScores scores;
  /// Once, all models.
  double making_s = 0.0;
  /// Of the wall's clock, and of all cores, for each frame with all its requests.
  std::vector<double> wall_s;
  std::vector<double> cpu_s;
};

/// What was run, for both reports.
struct RunFacts {
  std::string set;
  std::size_t scenes = 0;
  std::size_t models = 0;
  int threads = 1;
};

[[nodiscard]] std::string markdown(RunFacts const& facts, std::vector<MethodResult> const& results);
[[nodiscard]] std::string json(RunFacts const& facts, std::vector<MethodResult> const& results);

}  // namespace credo
