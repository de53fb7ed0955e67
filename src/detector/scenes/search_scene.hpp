#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/cloud.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/segments.hpp"
#include "detector/scenes/facets.hpp"
#include "geometry/depth_patch.hpp"

namespace credo {

/// What the search asks of a pixel, in one place.
struct ScenePixel {
  /// 0 where there is no depth.
  float depth_m = 0.0F;
  /// Unit normal towards the camera in steps of 1/127; all 0 where there is none.
  std::array<std::int8_t, 3> normal = {0, 0, 0};
  /// Position in SearchScene::planes; kNoPlane.
  std::uint8_t plane = 255;
  /// As in Segments: from 1; 0 for none.
  std::uint16_t segment = 0;

  [[nodiscard]] Eigen::Vector3f normal_camera() const {
    return Eigen::Vector3f(normal[0], normal[1], normal[2]) / 127.0F;
  }
  [[nodiscard]] bool has_normal() const {
    return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
  }
};

inline constexpr std::uint8_t kNoPlane = 255;

/// One piece of the frame. Camera frame.
struct SceneSegment {
  int pixels = 0;
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();
  /// Longest distance of its points along their main axis.
  float extent_m = 0.0F;
  /// Of its surface.
  float area_m2 = 0.0F;
};

/// A large flat surface, such as a floor, a wall or a table top: n . p = offset_m.
struct ScenePlane {
  /// Towards the camera.
  Eigen::Vector3f normal_camera = -Eigen::Vector3f::UnitZ();
  float offset_m = 0.0F;
  float extent_m = 0.0F;
  std::uint16_t segment = 0;
};

/// A frame made ready to be searched. Camera frame; immutable, for any number of threads.
struct SearchScene {
  CameraIntrinsics intrinsics;
  Grid<ScenePixel> pixels;
  /// Label i + 1.
  std::vector<SceneSegment> segments;
  /// Largest first.
  std::vector<ScenePlane> planes;
  /// Of all segments.
  std::vector<Facet> facets;

  [[nodiscard]] ImageSize size() const { return {pixels.width(), pixels.height()}; }
  [[nodiscard]] Eigen::Vector3f point_at(Pixel pixel) const {
    float const depth_m = pixels[pixel].depth_m;
    return {(static_cast<float>(pixel.u) - static_cast<float>(intrinsics.cx_px)) * depth_m /
                static_cast<float>(intrinsics.fx_px),
            (static_cast<float>(pixel.v) - static_cast<float>(intrinsics.cy_px)) * depth_m /
                static_cast<float>(intrinsics.fy_px),
            depth_m};
  }
  /// Whether a pixel is of a plane that is larger than a thing of that diameter.
  [[nodiscard]] bool is_background(ScenePixel const& pixel, float diameter_m) const {
    return pixel.plane != kNoPlane && planes[pixel.plane].extent_m > 1.2F * diameter_m;
  }
};

/// How far a depth may lie from where a model has its surface: the sensor's noise grows with the
/// square of the range.
[[nodiscard]] inline float depth_tolerance_m(float depth_m) {
  return 0.006F + 0.003F * depth_m * depth_m;
}

/// The deviation of a measured depth from a model's, at right angles to it (Nguyen, Izadi and
/// Lovell 2012, and 0.3 mm for the model).
[[nodiscard]] inline float depth_deviation_m(float depth_m) {
  float const beyond_m = depth_m - 0.4F;
  return 0.0015F + 0.0019F * beyond_m * beyond_m;
}

/// Any frame gives a scene; one without depth has no segments and no planes.
[[nodiscard]] SearchScene prepare_scene(Grid<float> const& depth_m,
                                        CameraIntrinsics const& intrinsics,
                                        NormalMap const& normals, Segments const& segments);

}  // namespace credo
