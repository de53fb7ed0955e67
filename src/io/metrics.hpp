#pragma once

#include <string>

#include "core/run_metrics.hpp"

namespace credo {

/// The text of metrics.json.
std::string metrics_json(RunMetrics const& metrics);

}  // namespace credo
