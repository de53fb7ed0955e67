#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "core/dds_config.hpp"

namespace credo {

/// How long a sample of so many bytes takes from one participant to another, on the topic
/// <prefix>/doctor. Each has a DDS domain of its own in this process, and the config's on the
/// network: so it takes the way that it takes between processes. None where it does not come in
/// time. Throws InputError as Participant does.
std::optional<std::chrono::nanoseconds> delivery_time(DdsConfig const& config, std::size_t bytes,
                                                      std::chrono::milliseconds most);

}  // namespace credo
