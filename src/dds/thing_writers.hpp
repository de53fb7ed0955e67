#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "core/belief.hpp"
#include "core/belief_summary.hpp"
#include "dds/participant.hpp"

namespace credo {

/// Writes each thing of the belief to its topic, with its points (idl/credo/things.idl), and
/// disposes of those that have left it.
class ThingWriters {
public:
  explicit ThingWriters(Participant const& participant);

  /// `summary` is of `belief`. Returns how many samples DDS did not take at once.
  std::uint64_t write(BeliefState const& belief, BeliefSummary summary, std::uint64_t revision);

private:
  std::string source_;
  DdsEntity floor_;
  DdsEntity walls_;
  DdsEntity objects_;
  DdsEntity stuff_;
  // Of the last belief.
  bool has_floor_ = false;
  std::set<std::uint32_t> wall_ids_;
  std::set<std::string> object_ids_;
  std::set<std::uint32_t> stuff_ids_;
};

}  // namespace credo
