// The one file of the tests that knows where they lie, so that all others compile to the same in
// any checkout.
#include "support/paths.hpp"

#include <cstdlib>

namespace credo::test {

std::filesystem::path source_folder() {
  return CREDO_SOURCE_DIR;
}

std::filesystem::path recordings() {
  char const* given = std::getenv("CREDO_DATA");
  return given != nullptr ? given : source_folder() / "../shared/data";
}

}  // namespace credo::test
