#pragma once

#include <string>

namespace credo {

/// What OpenNI2 says of its last error, on one line: its texts end with line breaks, and it knows
/// none for some errors.
std::string openni_error();

}  // namespace credo
