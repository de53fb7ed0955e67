#include "drivers/virtual/sensor_images.hpp"

#include <algorithm>
#include <cmath>

#include "core/capture_config.hpp"
#include "core/error.hpp"
#include "geometry/depth_registration.hpp"
#include "io/image.hpp"
#include "io/intrinsics.hpp"

namespace credo {
namespace {

constexpr std::uint16_t kInvalidCount = 65535;

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

Grid<std::uint16_t> in_millimetres(Grid<std::uint16_t> counts, double unit_m) {
  for (std::uint16_t& count : counts) {
    double const depth_mm = std::round(count * unit_m * 1000.0);
    count = count != kInvalidCount && depth_mm <= kMaxDepth_mm
                ? static_cast<std::uint16_t>(depth_mm)
                : std::uint16_t{0};
  }
  return counts;
}

}  // namespace

SensorDataset::SensorDataset(std::filesystem::path const& folder) : listing_(list_dataset(folder)) {
  SensorImages const first = read(0);
  width_ = first.depth_mm.width();
  height_ = first.depth_mm.height();
  intrinsics_ = find_intrinsics(folder, CaptureConfig{}, width_, height_, listing_.warnings);
}

SensorImages SensorDataset::read(std::size_t image) const {
  DatasetEntry const& entry = listing_.entries.at(image);
  if (!entry.cloud.empty()) {
    throw InputError(entry.cloud.string() +
                     ": is a cloud; a virtual sensor plays depth and colour images");
  }
  if (entry.depth.empty() || entry.color.empty()) {
    throw InputError((entry.depth.empty() ? entry.color : entry.depth).string() + ": its " +
                     (entry.depth.empty() ? "depth" : "colour") + " is missing");
  }
  SensorImages images{in_millimetres(read_png16(entry.depth), listing_.depth_unit_m),
                      read_color(entry.color)};
  bool const like_first =
      width_ == 0 || (images.depth_mm.width() == width_ && images.depth_mm.height() == height_);
  if (!like_first || !images.color.same_size(images.depth_mm)) {
    throw InputError(entry.depth.string() + ": depth is " +
                     size_text(images.depth_mm.width(), images.depth_mm.height()) + ", colour " +
                     size_text(images.color.width(), images.color.height()) +
                     (like_first ? "" : ", the first frame " + size_text(width_, height_)) +
                     "; all must be alike");
  }
  return images;
}

CameraIntrinsics infrared_of(CameraIntrinsics const& color) {
  DepthCalibration const kinect = kinect_calibration();
  CameraIntrinsics infrared = color;
  infrared.fx_px *= kinect.depth.fx_px / kinect.color.fx_px;
  infrared.fy_px *= kinect.depth.fy_px / kinect.color.fy_px;
  return infrared;
}

Grid<std::uint16_t> unregistered(Grid<std::uint16_t> const& depth_mm,
                                 CameraIntrinsics const& color) {
  Grid<float> depth_m(depth_mm.width(), depth_mm.height());
  std::ranges::transform(depth_mm, depth_m.begin(),
                         [](std::uint16_t mm) { return static_cast<float>(mm) / 1000.0F; });
  // The other way round: from the colour camera into the infrared one.
  DepthCalibration const calibration{.depth = color,
                                     .color = infrared_of(color),
                                     .T_color_depth = kinect_calibration().T_color_depth.inverse()};
  depth_m = register_depth(depth_m, calibration, depth_mm.width(), depth_mm.height());
  Grid<std::uint16_t> seen_mm(depth_mm.width(), depth_mm.height());
  std::ranges::transform(depth_m, seen_mm.begin(), [](float z_m) {
    return static_cast<std::uint16_t>(std::lround(1000.0F * z_m));
  });
  return seen_mm;
}

}  // namespace credo
