#include "core/dds_config.hpp"

namespace credo {

FieldList fields(DdsConfig& config) {
  // Ports of higher domains do not exist (RTPS 2.3, 9.6.1.1).
  constexpr Range kDomains = {0, 230};
  return {
      {"domain", &config.domain, kDomains, "",
       "DDS domain; only those on the same one see each other"},
      {"interface",
       &config.interface_name,
       {},
       "",
       "network interface for discovery and data; lo keeps both on this machine"},
      {"partition", &config.partition, {}, "", "DDS partition; empty = the default one"},
      {"topic_prefix", &config.topic_prefix, {}, "", "topics are called <prefix>/belief and so on"},
      {"source",
       &config.source,
       {},
       "",
       "name that tells this Credo from others; empty = host and process"},
  };
}

}  // namespace credo
