#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace credo::test {

/// What in a run's folder is not as the file formats have it (belief.jsonl, metrics.json,
/// config.yaml, labels/ where it is there); empty where all is. Written from the formats and not
/// from the code that writes them.
std::vector<std::string> contract_faults(std::filesystem::path const& out);

}  // namespace credo::test
