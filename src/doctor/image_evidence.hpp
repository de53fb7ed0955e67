#pragma once

#include <optional>
#include <vector>

#include "core/capture_config.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/plane.hpp"
#include "openni/registration_check.hpp"
#include "openni/sensor_image.hpp"

namespace credo {

/// A depth image [m], 0 = none, with the colour image nearest in time; that may be empty.
struct SensorView {
  Grid<float> depth_m;
  Grid<Rgb> color;
};

/// What a sensor's images show.
struct ImageEvidence {
  int views = 0;
  /// Pixels with depth.
  double valid_share = 0.0;
  /// Of these; 0 where there are none.
  double median_depth_m = 0.0;
  /// Mean of all channels, 0 to 255; none without colour.
  std::optional<double> color_brightness;
  Registration registration = Registration::kUndecided;
  /// In the camera's frame; of the first view that shows one.
  std::optional<Plane> floor;
};

/// Looks at what was kept of a sensor. `optics` and `capture` tell its focal length.
ImageEvidence evidence_of(std::vector<SensorView> const& views, DepthOptics const& optics,
                          CaptureConfig const& capture);

}  // namespace credo
