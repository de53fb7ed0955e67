#include "io/intrinsics.hpp"

#include <array>
#include <cmath>
#include <fstream>

#include "core/error.hpp"

namespace credo {
namespace {

constexpr double kDefaultFocalLengthPx = 525.0;

}  // namespace

CameraIntrinsics read_intrinsics(std::filesystem::path const& path) {
  std::ifstream file(path);
  std::array<double, 9> k{};
  for (double& value : k) {
    if (!(file >> value) || !std::isfinite(value)) {
      throw InputError(path.string() + ": needs nine numbers, a 3x3 camera matrix");
    }
  }
  if (!(k[0] > 0) || !(k[4] > 0) || std::abs(k[1]) > 1e-6 || std::abs(k[3]) > 1e-6 ||
      std::abs(k[6]) > 1e-9 || std::abs(k[7]) > 1e-9 || std::abs(k[8] - 1.0) > 1e-9) {
    throw InputError(path.string() + ": not a pinhole camera matrix (fx 0 cx, 0 fy cy, 0 0 1)");
  }
  return {k[0], k[4], k[2], k[5]};
}

CameraIntrinsics find_intrinsics(std::filesystem::path const& folder, CaptureConfig const& config,
                                 int width, int height, std::vector<std::string>& warnings) {
  auto const file = folder / "camera-intrinsics.txt";
  if (std::filesystem::exists(file)) {
    return read_intrinsics(file);
  }
  if (config.camera_fx_px > 0 && config.camera_fy_px > 0 && config.camera_cx_px > 0 &&
      config.camera_cy_px > 0) {
    return {config.camera_fx_px, config.camera_fy_px, config.camera_cx_px, config.camera_cy_px};
  }
  warnings.push_back(file.string() +
                     " not found and capture.camera.* not given: taking 525 px and the middle");
  return {kDefaultFocalLengthPx, kDefaultFocalLengthPx, 0.5 * (width - 1), 0.5 * (height - 1)};
}

}  // namespace credo
