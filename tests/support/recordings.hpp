#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace credo::test {

/// Folder of the real recordings: $CREDO_DATA, else beside the checkout.
inline std::filesystem::path recordings() {
  char const* given = std::getenv("CREDO_DATA");
  return given != nullptr ? given : CREDO_DATA_DIR;
}

}  // namespace credo::test

/// Ends the test as skipped, with the reason, where a recording is not on this machine.
#define CREDO_REQUIRE_RECORDING(name)                                         \
  do {                                                                        \
    if (!std::filesystem::exists(credo::test::recordings() / (name))) {       \
      GTEST_SKIP() << "no recording " << (credo::test::recordings() / (name)) \
                   << "; set CREDO_DATA to the folder that holds it";         \
    }                                                                         \
  } while (false)
