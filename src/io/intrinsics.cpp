#include "io/intrinsics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.hpp"

namespace credo {
namespace {

constexpr double kDefaultFocalLengthPx = 525.0;

/// Intrinsics for another resolution are a common slip, and their principal point tells most.
CameraIntrinsics checked(CameraIntrinsics const& k, int width, int height,
                         std::string const& where) {
  if (k.cx_px < 0 || k.cy_px < 0 || k.cx_px > width || k.cy_px > height) {
    std::ostringstream text;
    text << where << ": principal point (" << k.cx_px << ", " << k.cy_px << ") is not in the "
         << width << "x" << height << " image: intrinsics of another resolution?";
    throw InputError(text.str());
  }
  return k;
}

}  // namespace

CameraIntrinsics read_intrinsics(std::filesystem::path const& path) {
  std::ifstream file(path);
  std::array<double, 9> k{};
  std::string more;
  for (double& value : k) {
    if (!(file >> value) || !std::isfinite(value)) {
      throw InputError(path.string() + ": needs nine numbers, a 3x3 camera matrix");
    }
  }
  if (file >> more) {
    throw InputError(path.string() + ": has more than nine numbers, a 3x3 camera matrix");
  }
  if (!(k[0] > 0) || !(k[4] > 0) || std::abs(k[1]) > 1e-6 || std::abs(k[3]) > 1e-6 ||
      std::abs(k[6]) > 1e-9 || std::abs(k[7]) > 1e-9 || std::abs(k[8] - 1.0) > 1e-9) {
    throw InputError(path.string() + ": not a pinhole camera matrix (fx 0 cx, 0 fy cy, 0 0 1)");
  }
  return {k[0], k[4], k[2], k[5]};
}

std::optional<CameraIntrinsics> given_intrinsics(CaptureConfig const& config, int width,
                                                 int height) {
  std::array const given = {config.camera_fx_px, config.camera_fy_px, config.camera_cx_px,
                            config.camera_cy_px};
  auto const count = std::count_if(given.begin(), given.end(), [](double v) { return v > 0; });
  if (count == 4) {
    return checked({given[0], given[1], given[2], given[3]}, width, height, "capture.camera");
  }
  if (count > 0) {
    throw InputError("capture.camera: give all four of fx_px, fy_px, cx_px, cy_px, or none");
  }
  return std::nullopt;
}

CameraIntrinsics find_intrinsics(std::filesystem::path const& folder, CaptureConfig const& config,
                                 int width, int height, std::vector<std::string>& warnings) {
  auto const file = folder / "camera-intrinsics.txt";
  if (std::filesystem::exists(file)) {
    return checked(read_intrinsics(file), width, height, file.string());
  }
  if (auto const given = given_intrinsics(config, width, height)) {
    return *given;
  }
  warnings.push_back(folder.string() +
                     ": no camera-intrinsics.txt and no capture.camera: taking a focal length of "
                     "525 px and the middle of the image");
  return {kDefaultFocalLengthPx, kDefaultFocalLengthPx, 0.5 * (width - 1), 0.5 * (height - 1)};
}

}  // namespace credo
