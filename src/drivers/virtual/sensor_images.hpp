#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "io/dataset_listing.hpp"

namespace credo {

/// One frame of a dataset as a sensor would see it. Depth in mm, 0 none or beyond 10 m.
struct SensorImages {
  Grid<std::uint16_t> depth_mm;
  Grid<Rgb> color;
};
using SensorImagesPtr = std::shared_ptr<SensorImages const>;

inline constexpr std::uint16_t kMaxDepth_mm = 10'000;

/// A dataset's images, read one by one. Layouts: those of open_dataset with images in them; without
/// camera-intrinsics.txt 525 px and the middle of the image.
class SensorDataset {
public:
  /// Reads the first frame; throws InputError where it is not good, or all is clouds.
  explicit SensorDataset(std::filesystem::path const& folder);

  [[nodiscard]] std::size_t count() const { return listing_.entries.size(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] CameraIntrinsics const& intrinsics() const { return intrinsics_; }
  [[nodiscard]] std::vector<std::string> const& warnings() const { return listing_.warnings; }

  /// Throws InputError where a file is missing, damaged, or not of the first frame's size.
  [[nodiscard]] SensorImages read(std::size_t image) const;

private:
  DatasetListing listing_;
  int width_ = 0;
  int height_ = 0;
  CameraIntrinsics intrinsics_;
};

/// The lens of the infrared camera beside that colour camera: as much longer as a Kinect's.
CameraIntrinsics infrared_of(CameraIntrinsics const& color);

/// Depth as the infrared camera sees it, which stands a Kinect's 25 mm to the left of the colour
/// camera and looks the same way. 0 where it sees what the colour camera does not.
Grid<std::uint16_t> unregistered(Grid<std::uint16_t> const& depth_mm,
                                 CameraIntrinsics const& color);

}  // namespace credo
