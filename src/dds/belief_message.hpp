#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/belief_summary.hpp"

struct credo_msg_Belief;

namespace credo {

/// A belief as it travels (idl/credo/belief.idl), with all that the C struct points to.
class BeliefMessage {
public:
  BeliefMessage(std::string source, std::uint64_t revision, BeliefSummary belief);
  BeliefMessage(BeliefMessage const&) = delete;
  BeliefMessage& operator=(BeliefMessage const&) = delete;
  BeliefMessage(BeliefMessage&&) = delete;
  BeliefMessage& operator=(BeliefMessage&&) = delete;
  ~BeliefMessage();

  [[nodiscard]] credo_msg_Belief const& sample() const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The other way; equal, to the bit, to what the message was made of. What a sample of another
/// make holds beyond our types (an evidence or a label that we do not know) throws
/// std::runtime_error.
[[nodiscard]] BeliefSummary belief_in(credo_msg_Belief const& sample);

}  // namespace credo
