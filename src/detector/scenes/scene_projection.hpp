#pragma once

#include <Eigen/Core>

#include "detector/scenes/search_scene.hpp"

namespace credo {

/// Where points fall in the image of a scene.
class SceneProjection {
public:
  explicit SceneProjection(SearchScene const& scene)
      : pixels_(scene.pixels),
        fx_(static_cast<float>(scene.intrinsics.fx_px)),
        fy_(static_cast<float>(scene.intrinsics.fy_px)),
        cx_(static_cast<float>(scene.intrinsics.cx_px) + 0.5F),
        cy_(static_cast<float>(scene.intrinsics.cy_px) + 0.5F),
        width_(static_cast<float>(scene.pixels.width())),
        height_(static_cast<float>(scene.pixels.height())) {}

  /// Its pixel; null outside of the image and behind the camera.
  ScenePixel const* operator()(Eigen::Vector3f const& p_camera) const {
    Pixel pixel;
    return at(p_camera, pixel) ? &pixels_[pixel] : nullptr;
  }
  /// The same, by its place.
  bool at(Eigen::Vector3f const& p_camera, Pixel& pixel) const {
    if (!(p_camera.z() > 0.0F)) {
      return false;
    }
    float const per_m = 1.0F / p_camera.z();
    float const u = fx_ * p_camera.x() * per_m + cx_;
    float const v = fy_ * p_camera.y() * per_m + cy_;
    if (!(u >= 0.0F && v >= 0.0F && u < width_ && v < height_)) {
      return false;
    }
    pixel = {static_cast<int>(u), static_cast<int>(v)};
    return true;
  }

private:
  Grid<ScenePixel> const& pixels_;
  float fx_;
  float fy_;
  float cx_;
  float cy_;
  float width_;
  float height_;
};

}  // namespace credo
