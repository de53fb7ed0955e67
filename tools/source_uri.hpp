#pragma once

#include <stop_token>
#include <string>

#include "core/capture_config.hpp"
#include "core/sensor_config.hpp"
#include "core/sim_config.hpp"
#include "io/dataset.hpp"
#include "openni/openni_source.hpp"

namespace credo {

/// Opens what `--source` names: `dataset:DIR`, `sim:NAME-or-FILE`, `oni:FILE`, `openni:` or
/// `openni:URI`; the last ends on `stop`, and has `notes` for people. Throws InputError where it
/// cannot be opened or is of no kind known.
OpenedSource open_source(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose, SensorConfig const& sensor, SimConfig const& sim,
                         LiveNotes const& notes, std::stop_token const& stop);

/// Whether that is a sensor, which plays in real time and does not end by itself.
[[nodiscard]] inline bool is_live(std::string const& uri) {
  return uri.starts_with("openni:");
}

}  // namespace credo
