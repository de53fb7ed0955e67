#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/truth.hpp"

namespace credo {

/// A line of truth.jsonl, without its line end: like a line of belief.jsonl, but true.
std::string truth_json(FrameTruth const& truth);

/// The lines of a truth.jsonl, in order. Only `frame`, `stamp_ns` and `T_world_camera` must be
/// there: whoever labels a recording by hand tells what is known. Throws InputError naming the line
/// that is not such a truth, or whose frame is not after the one before.
std::vector<FrameTruth> read_truth(std::filesystem::path const& path);

}  // namespace credo
