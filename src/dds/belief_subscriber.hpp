#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/dds_config.hpp"
#include "dds/participant.hpp"

namespace credo {

/// A belief as it came, and from which Credo.
struct ReceivedBelief {
  std::string source;
  std::uint64_t revision = 0;
  BeliefSummary belief;
  /// Its source has left the domain or was lost; `belief` is empty then.
  bool gone = false;
};

/// Listens to <prefix>/belief. Someone who comes late has the last belief of every source at once;
/// someone who is slow gets the newest and not all.
class BeliefSubscriber {
public:
  /// Throws InputError where DDS refuses (Participant).
  explicit BeliefSubscriber(DdsConfig const& config);

  /// What has come since the last call, waiting for it no longer than the timeout; empty then.
  std::vector<ReceivedBelief> take(std::chrono::milliseconds timeout);

private:
  Participant participant_;
  DdsEntity reader_;
  DdsEntity waitset_;
};

}  // namespace credo
