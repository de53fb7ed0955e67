#pragma once

#include <string>

#include "core/fields.hpp"

namespace credo {

/// Where and as what the belief is published on DDS, and where a subscriber looks for it.
struct DdsConfig {
  int domain = 0;
  /// Network interface for discovery and data. The loopback: nothing leaves the machine unless
  /// asked.
  std::string interface_name = "lo";
  /// Empty: the default partition.
  std::string partition;
  /// Topics are called <prefix>/belief and so on.
  std::string topic_prefix = "credo";
  /// The name under which this Credo publishes; subscribers tell several apart by it. Empty: host
  /// and process.
  std::string source;
};
FieldList fields(DdsConfig& config);

}  // namespace credo
