#include "doctor/computer.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "core/error.hpp"
#include "dds/delivery_check.hpp"
#include "dds/participant.hpp"
#include "doctor/text.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

/// As large as a floor with its points.
constexpr std::size_t kSample_bytes = 1'000'000;
constexpr std::chrono::milliseconds kDeliveryPatience{5000};

/// linux/if.h, which clashes with net/if.h.
constexpr unsigned kUp = 0x1;
constexpr unsigned kLoopback = 0x8;
constexpr unsigned kMulticast = 0x1000;

std::vector<NetworkInterface> read_interfaces(fs::path const& folder) {
  std::vector<NetworkInterface> interfaces;
  std::error_code error;
  for (auto const& entry : fs::directory_iterator(folder, error)) {
    if (auto const text = first_line(entry.path() / "flags")) {
      auto const flags = static_cast<unsigned>(std::strtoul(text->c_str(), nullptr, 16));
      interfaces.push_back({.name = entry.path().filename(),
                            .up = (flags & kUp) != 0,
                            .loopback = (flags & kLoopback) != 0,
                            .multicast = (flags & kMulticast) != 0});
    }
  }
  std::ranges::sort(interfaces, {}, &NetworkInterface::name);
  return interfaces;
}

std::vector<std::string> read_cpu_flags(fs::path const& cpuinfo) {
  std::ifstream file(cpuinfo);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("flags")) {
      std::istringstream words(line.substr(line.find(':') + 1));
      return {std::istream_iterator<std::string>(words), {}};
    }
  }
  return {};
}

void judge_cpu(ComputerState const& computer, Section& section) {
  std::string const cores = std::to_string(computer.cores);
  if (computer.cores < 2) {
    section.warning("processor", cores + " core: the stages of a frame then wait for each other",
                    "run on a computer with two cores or more; until then: --config "
                    "config/live.yaml, which takes the newest frame");
  } else if (!computer.cpu_flags.empty() &&
             std::ranges::find(computer.cpu_flags, "avx2") == computer.cpu_flags.end()) {
    section.warning("processor", cores + " cores, without AVX2: image kernels take longer",
                    "if frames are dropped: --config config/live.yaml, which takes the newest");
  } else {
    section.ok("processor", cores + " cores" + (computer.cpu_flags.empty() ? "" : ", AVX2"));
  }
}

/// Where images come late, that may be this computer's fault, not the sensor's.
void judge_load(ComputerState const& computer, Section& section) {
  if (!computer.load) {
    return;
  }
  std::string const found = fixed_text(*computer.load, 1) + " programs ran or wanted to, on " +
                            std::to_string(computer.cores) + " cores, over the last minute";
  if (*computer.load > computer.cores) {
    section.warning("load", found + ": images may be late or lost for that alone",
                    "end what you can do without (top), and then: credo doctor");
  } else {
    section.ok("load", found);
  }
}

void judge_buffers(ComputerState const& computer, Section& section) {
  if (!computer.rmem_max_bytes) {
    section.warning("socket buffers", "net.core.rmem_max cannot be read",
                    "sysctl net.core.rmem_max on the host must say 1048576 or more");
  } else if (receive_buffer_warning(*computer.rmem_max_bytes)) {
    section.warning("socket buffers",
                    "net.core.rmem_max is " + std::to_string(*computer.rmem_max_bytes) +
                        " bytes: subscribers may lose samples of megabytes and wait for them again",
                    "sudo sysctl -w net.core.rmem_max=4194304; and for good: echo "
                    "net.core.rmem_max=4194304 | sudo tee /etc/sysctl.d/60-credo.conf");
  } else {
    section.ok("socket buffers",
               "net.core.rmem_max is " + std::to_string(*computer.rmem_max_bytes) + " bytes");
  }
}

void judge_interface(std::vector<NetworkInterface> const& interfaces, std::string const& name,
                     Section& section) {
  std::string const title = "interface " + name;
  auto const found = std::ranges::find(interfaces, name, &NetworkInterface::name);
  if (found == interfaces.end()) {
    std::vector<std::string> names;
    std::ranges::transform(interfaces, std::back_inserter(names), &NetworkInterface::name);
    section.error(title, "is not there; there are " + joined(names),
                  "--set dds.interface=lo keeps to this computer; to reach others, name one of "
                  "these");
  } else if (!found->up) {
    section.error(title, "is down", "sudo ip link set " + name + " up");
  } else if (!found->multicast && !found->loopback) {
    section.warning(title, "has no multicast, by which DDS finds its peers",
                    "sudo ip link set " + name +
                        " multicast on; or name the peers in a file for CYCLONEDDS_URI");
  } else {
    section.ok(title, found->loopback ? "up; what is published stays on this computer" : "up");
  }
}

void judge_delivery(DdsDelivery const& delivery, DdsConfig const& config, bool uri_given,
                    Section& section) {
  std::string const way =
      (uri_given ? std::string("as CYCLONEDDS_URI says") : "over " + config.interface_name) +
      ", domain " + std::to_string(config.domain);
  if (!delivery.trouble.empty()) {
    section.error("DDS", delivery.trouble,
                  uri_given ? "unset CYCLONEDDS_URI, or mend the configuration that it names"
                            : "--set dds.interface=lo keeps to this computer; credo run --no-dds "
                              "does without");
  } else if (!delivery.time) {
    section.error("DDS", "a sample of 1 MB did not come from a writer to a reader in 5 s, " + way,
                  "does a firewall drop UDP there? sudo iptables -L; on this computer alone: --set "
                  "dds.interface=lo");
  } else {
    double const ms = std::chrono::duration<double, std::milli>(*delivery.time).count();
    section.ok("DDS", "a sample of 1 MB came from a writer to a reader in " + fixed_text(ms, 1) +
                          " ms, " + way);
  }
}

}  // namespace

ComputerState read_computer(fs::path const& root) {
  ComputerState computer;
  computer.cores = static_cast<int>(std::thread::hardware_concurrency());
  if (auto const load = first_line(root / "proc/loadavg")) {
    computer.load = std::strtod(load->c_str(), nullptr);
  }
  computer.cpu_flags = read_cpu_flags(root / "proc/cpuinfo");
  if (auto const limit = first_line(root / "proc/sys/net/core/rmem_max")) {
    computer.rmem_max_bytes = std::strtoll(limit->c_str(), nullptr, 10);
  }
  computer.interfaces = read_interfaces(root / "sys/class/net");
  return computer;
}

DdsDelivery try_dds(DdsConfig const& config) {
  try {
    return {delivery_time(config, kSample_bytes, kDeliveryPatience), ""};
  } catch (InputError const& error) {
    return {std::nullopt, error.what()};
  }
}

std::vector<Finding> computer_findings(ComputerState const& computer, DdsConfig const& config,
                                       bool uri_given, DdsDelivery const& delivery) {
  Section section("this computer");
  judge_cpu(computer, section);
  judge_load(computer, section);
  judge_buffers(computer, section);
  if (!uri_given) {
    judge_interface(computer.interfaces, config.interface_name, section);
  }
  judge_delivery(delivery, config, uri_given, section);
  return section.take();
}

}  // namespace credo
