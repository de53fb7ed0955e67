#pragma once

#include <string>

#include "core/truth.hpp"

namespace credo {

/// A line of truth.jsonl, without its line end: like a line of belief.jsonl, but true.
std::string truth_json(FrameTruth const& truth);

}  // namespace credo
