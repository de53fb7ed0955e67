#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "support/paths.hpp"

/// Ends the test as skipped, with the reason, where a recording is not on this machine.
#define CREDO_REQUIRE_RECORDING(name)                                         \
  do {                                                                        \
    if (!std::filesystem::exists(credo::test::recordings() / (name))) {       \
      GTEST_SKIP() << "no recording " << (credo::test::recordings() / (name)) \
                   << "; set CREDO_DATA to the folder that holds it";         \
    }                                                                         \
  } while (false)
