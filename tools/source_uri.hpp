#pragma once

#include <stop_token>
#include <string>

#include "core/capture_config.hpp"
#include "core/sim_config.hpp"
#include "io/dataset.hpp"

namespace credo {

/// Opens what `--source` names: `dataset:DIR`, `sim:NAME-or-FILE`, `oni:FILE`, `openni:` or
/// `openni:URI`; the last ends on `stop`. Throws InputError where it cannot be opened or is of no
/// kind known.
OpenedSource open_source(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose, SimConfig const& sim, std::stop_token const& stop);

}  // namespace credo
