#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/capture_config.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"

namespace credo {

// What recordings and sensors of OpenNI have in common.

/// What a stream says of its depth images.
struct DepthOptics {
  int width_px = 0;
  int height_px = 0;
  std::optional<double> horizontal_fov_rad;
  std::optional<double> vertical_fov_rad;
};

/// Those of the config where it gives them; else of the field of view, around the middle of the
/// image; else 525 px at a width of 640. Throws InputError as given_intrinsics does.
CameraIntrinsics intrinsics_of(DepthOptics const& optics, CaptureConfig const& config);

/// Metres of depth counts (mm, or capture.depth_unit_m); 0, 65535 and what lies beyond
/// capture.max_depth_m become 0. `counts` are width x height, row by row.
Grid<float> depth_image(std::span<std::uint16_t const> counts, int width, int height,
                        CaptureConfig const& config);

/// Swaps left and right.
template <typename T>
void mirror(Grid<T>& image);

extern template void mirror(Grid<float>&);
extern template void mirror(Grid<Rgb>&);

}  // namespace credo
