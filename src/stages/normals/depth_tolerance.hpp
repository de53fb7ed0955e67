#pragma once

namespace credo::normals {

/// How far two depths may differ and still belong to one surface: jump_m + noise_per_m z^2 metres,
/// which is jump_m w^2 + noise_per_m in inverse depth w.
struct DepthTolerance {
  float jump_m = 0.0F;
  float noise_per_m = 0.0F;
};

/// Inverse depth of a block that holds no valid pixel. Not NaN, so that maxima need no care.
inline constexpr float kNothing = -1e30F;

}  // namespace credo::normals
