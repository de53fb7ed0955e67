#pragma once

#include <optional>

#include "core/cloud.hpp"
#include "core/plane.hpp"
#include "stages/capture/coarse_cloud.hpp"

namespace credo {

/// The floor in one frame, without any knowledge of where the camera is: the largest plane that
///  - faces roughly up (within 65 degrees of the camera's -y),
///  - has nothing beneath it, and
///  - does not end like a table top: along its outline there are things that stand on it or hide
///  it,
///    or the picture ends, rather than a drop or a wide stretch without depth.
/// Camera frame, normal up, refined to the sensor's noise. None where no plane qualifies, which is
/// the usual answer to a table top that fills the view.
std::optional<Plane> find_floor(OrganizedCloud const& cloud);
std::optional<Plane> find_floor(CoarseCloud const& coarse);

}  // namespace credo
