#pragma once

#include <stdexcept>

namespace credo {

/// The outside world (file, device, config, command line) is not as it must be. The text is one
/// line that says what, where and what to do; `main` prints it and exits with 2.
class InputError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace credo
