#pragma once

#include <string>

#include "core/scores.hpp"

namespace credo {

/// What `credo eval --json` prints, on several lines: null where there is nothing to say.
std::string scores_json(Scores const& scores);

}  // namespace credo
