#include "run_beliefs.hpp"

#include <string>

#include "core/error.hpp"
#include "io/belief_json.hpp"

namespace credo {

std::vector<BeliefSummary> beliefs_of_run(std::filesystem::path const& run) {
  std::filesystem::path const path = run / "belief.jsonl";
  if (!std::filesystem::is_regular_file(path)) {
    throw InputError(run.string() + ": no run: it has no belief.jsonl (credo run --out writes it)");
  }
  std::vector<BeliefSummary> beliefs = read_beliefs(path);
  if (beliefs.empty()) {
    throw InputError(path.string() + ": holds no belief: the run had no good frame");
  }
  return beliefs;
}

}  // namespace credo
