#include "doctor/image_evidence.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/depth_registration.hpp"
#include "stages/capture/floor_search.hpp"

namespace credo {
namespace {

/// RegistrationCheck looks at every fifth frame; those that are kept are far enough apart.
constexpr int kFramesPerLook = 5;
constexpr double kKinectWidth_px = 640.0;
/// A floor that is in view is mostly found at once.
constexpr std::size_t kMostFloorSearches = 5;

Registration registration_of(std::vector<SensorView> const& views, DepthOptics const& optics) {
  RegistrationCheck check(scaled(kinect_calibration(), optics.width_px / kKinectWidth_px));
  Registration found = Registration::kUndecided;
  for (SensorView const& view : views) {
    for (int i = 0; i < kFramesPerLook && !view.color.empty(); ++i) {
      found = check.add(view.depth_m, view.color);
    }
  }
  return found;
}

std::optional<Plane> floor_of(std::vector<SensorView> const& views,
                              CameraIntrinsics const& intrinsics) {
  std::size_t const step = std::max<std::size_t>(1, views.size() / kMostFloorSearches);
  for (std::size_t i = 0; i < views.size(); i += step) {
    if (auto floor = find_floor(cloud_from_depth(views[i].depth_m, intrinsics))) {
      return floor;
    }
  }
  return std::nullopt;
}

double brightness_of(Grid<Rgb> const& color) {
  double sum = 0.0;
  for (Rgb const& pixel : color) {
    sum += pixel[0] + pixel[1] + pixel[2];
  }
  return sum / (3.0 * static_cast<double>(color.size()));
}

}  // namespace

ImageEvidence evidence_of(std::vector<SensorView> const& views, DepthOptics const& optics,
                          CaptureConfig const& capture) {
  ImageEvidence evidence;
  evidence.views = static_cast<int>(views.size());
  std::vector<float> depths_m;
  std::size_t pixels = 0;
  double brightness = 0.0;
  int colored = 0;
  for (SensorView const& view : views) {
    std::ranges::copy_if(view.depth_m, std::back_inserter(depths_m),
                         [](float z_m) { return z_m > 0.0F; });
    pixels += view.depth_m.size();
    if (!view.color.empty()) {
      brightness += brightness_of(view.color);
      ++colored;
    }
  }
  if (!depths_m.empty()) {
    evidence.valid_share = static_cast<double>(depths_m.size()) / static_cast<double>(pixels);
    auto const middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
    std::ranges::nth_element(depths_m, middle);
    evidence.median_depth_m = *middle;
  }
  if (colored > 0) {
    evidence.color_brightness = brightness / colored;
  }
  evidence.registration = registration_of(views, optics);
  evidence.floor = floor_of(views, intrinsics_of(optics, capture));
  return evidence;
}

}  // namespace credo
