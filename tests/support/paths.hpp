#pragma once

#include <filesystem>

namespace credo::test {

/// The checkout that this build was made of.
std::filesystem::path source_folder();

/// The real recordings: $CREDO_DATA, else beside the checkout.
std::filesystem::path recordings();

}  // namespace credo::test
