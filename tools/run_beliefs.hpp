#pragma once

#include <filesystem>
#include <vector>

#include "core/belief_summary.hpp"

namespace credo {

/// What a folder that `credo run --out` wrote believes, frame by frame; never empty. Throws
/// InputError where it holds no such thing.
[[nodiscard]] std::vector<BeliefSummary> beliefs_of_run(std::filesystem::path const& run);

}  // namespace credo
