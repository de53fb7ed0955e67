#pragma once

#include <optional>
#include <span>
#include <vector>

#include "detector/models/prepared_model.hpp"

namespace credo {

/// Raised with every change to what a prepared model holds, or to how it is made.
inline constexpr int kPreparationVersion = 3;

/// All that preparing a model takes time for, to the bit: not its name and its symmetry, which the
/// model tells by itself.
[[nodiscard]] std::vector<unsigned char> archived(PreparedModel const& model);

/// The reverse; none where the bytes are too few or too many. Other faults are not seen: hold a sum
/// against them.
[[nodiscard]] std::optional<PreparedModel> unarchived(std::span<unsigned char const> bytes);

}  // namespace credo
