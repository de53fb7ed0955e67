#pragma once

#include <vector>

#include "core/object_model.hpp"

namespace credo {

/// Twenty-seven things of a household, made by code: boxes, vessels with and without a handle,
/// tools. Each between 6 and 35 cm long, as a closed mesh about the middle of its bounds, upright
/// along z, with the symmetry that its shape has (depth shows no print). Parts of one model reach
/// into each other by a few millimetres. In order of their names; always the same.
[[nodiscard]] std::vector<ObjectModel> household_models();

}  // namespace credo
