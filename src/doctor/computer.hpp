#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/dds_config.hpp"
#include "doctor/finding.hpp"

namespace credo {

/// A network interface as the kernel sees it.
struct NetworkInterface {
  std::string name;
  bool up = false;
  bool loopback = false;
  bool multicast = false;
};

/// How a sample came from one DDS participant to another.
struct DdsDelivery {
  /// None where it did not come.
  std::optional<std::chrono::nanoseconds> time;
  /// Why DDS did not start; else empty.
  std::string trouble;
};

/// What Credo needs of a computer.
struct ComputerState {
  int cores = 0;
  /// Of the last minute: programs that run or want to; none where the kernel does not tell.
  std::optional<double> load;
  /// "avx2" and so on; empty where the kernel does not tell.
  std::vector<std::string> cpu_flags;
  /// What sockets may buffer at most; none where the kernel does not tell.
  std::optional<std::int64_t> rmem_max_bytes;
  /// By name.
  std::vector<NetworkInterface> interfaces;
};

/// Below `root`: proc/cpuinfo, proc/loadavg, proc/sys/net and sys/class/net. The cores are those
/// that this process may use.
ComputerState read_computer(std::filesystem::path const& root = "/");

/// Sends a sample of a megabyte through DDS.
DdsDelivery try_dds(DdsConfig const& config);

/// `uri_given`: CYCLONEDDS_URI says where DDS listens, instead of the config.
std::vector<Finding> computer_findings(ComputerState const& computer, DdsConfig const& config,
                                       bool uri_given, DdsDelivery const& delivery);

}  // namespace credo
