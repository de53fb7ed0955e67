#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/belief_summary.hpp"

namespace credo {

/// A belief as one line of belief.jsonl, without the line's end: schema 1, world frame, metres,
/// quaternions x y z w, numbers that read back to the same bits.
std::string belief_json(BeliefSummary const& belief);

/// The beliefs of a belief.jsonl, in order; numbers as they were written, to the bit. Keys that are
/// not known are passed over: what wrote them may be newer. Throws InputError naming the line that
/// is not such a belief, or whose frame is not after the one before.
std::vector<BeliefSummary> read_beliefs(std::filesystem::path const& path);

}  // namespace credo
