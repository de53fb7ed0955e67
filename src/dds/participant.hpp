#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/dds_config.hpp"
#include "dds/entity.hpp"

namespace credo {

/// This process on a DDS domain: discovery pinned to the config's interface, sizes tuned for
/// samples of megabytes. Where CYCLONEDDS_URI is set it says both instead.
///
/// One at a time for a domain in a process. Throws InputError where DDS refuses: an interface that
/// is not there, a CYCLONEDDS_URI that is no configuration.
class Participant {
public:
  explicit Participant(DdsConfig const& config);
  /// Under another number in this process, and the config's on the network: so two of them in one
  /// process meet there, and only there.
  Participant(DdsConfig const& config, std::uint32_t domain_here);

  [[nodiscard]] std::int32_t handle() const { return participant_.handle(); }
  /// Of the config, or host and process.
  [[nodiscard]] std::string const& source() const { return source_; }
  [[nodiscard]] std::string topic(std::string const& name) const { return prefix_ + "/" + name; }
  /// Of the config; may be empty.
  [[nodiscard]] std::string const& partition() const { return partition_; }

private:
  // In this order: a domain goes last.
  DdsEntity domain_;
  DdsEntity participant_;
  std::string source_;
  std::string prefix_;
  std::string partition_;
};

/// A line for people where the kernel lets sockets buffer too little for samples of megabytes.
[[nodiscard]] std::optional<std::string> receive_buffer_warning(std::int64_t rmem_max_bytes);
/// The kernel's limit; 0 where it does not tell.
[[nodiscard]] std::int64_t rmem_max_bytes();

}  // namespace credo
