#pragma once

#include <string>

#include "core/belief_summary.hpp"

namespace credo {

/// A belief as one line of belief.jsonl, without the line's end: schema 1, world frame, metres,
/// quaternions x y z w, numbers that read back to the same bits.
std::string belief_json(BeliefSummary const& belief);

}  // namespace credo
