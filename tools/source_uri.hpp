#pragma once

#include <string>

#include "core/capture_config.hpp"
#include "io/dataset.hpp"

namespace credo {

/// Opens what `--source` names: `dataset:DIR`, `sim:NAME-or-FILE`. Throws InputError where it
/// cannot be opened or is of no kind known.
OpenedSource open_source(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose);

}  // namespace credo
