#pragma once

#include <string>

#include "core/scores.hpp"

namespace credo {

/// The scores for people, one line a group; "-" where there is nothing to say.
std::string score_table(Scores const& scores);

}  // namespace credo
