#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/capture_config.hpp"
#include "core/frame.hpp"

namespace credo {

/// The 3x3 matrix of a camera-intrinsics.txt, nine numbers row by row. Throws InputError where the
/// file cannot be read or is no pinhole matrix (focal lengths positive, last row 0 0 1, no skew).
CameraIntrinsics read_intrinsics(std::filesystem::path const& path);

/// Those that the config gives; none where it gives none. Throws InputError where it gives some of
/// the four only, or where the principal point is outside the image of `width` x `height` pixels.
std::optional<CameraIntrinsics> given_intrinsics(CaptureConfig const& config, int width,
                                                 int height);

/// Those of `folder`/camera-intrinsics.txt, else of the config, else 525 px and the middle of the
/// image, with a line added to `warnings`. Throws InputError also where the config gives some of
/// the four only, or where the principal point is outside the image of `width` x `height` pixels.
CameraIntrinsics find_intrinsics(std::filesystem::path const& folder, CaptureConfig const& config,
                                 int width, int height, std::vector<std::string>& warnings);

}  // namespace credo
