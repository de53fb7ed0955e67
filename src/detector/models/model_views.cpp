#include "detector/models/model_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/frame.hpp"
#include "detector/models/view_directions.hpp"
#include "detector/poses/camera_pose.hpp"
#include "geometry/depth_patch.hpp"

namespace credo {
namespace {

constexpr int kViewSize_px = 200;
/// A camera so far away, in radii of the model, that it sees nearly in parallel.
constexpr float kDistance_radii = 6.0F;
/// Cosine of the angle between normal and ray from which on a surface is seen.
constexpr float kLeastIncidence = 0.1F;
constexpr std::size_t kMaxOutline = 64;
constexpr float kInside_m = 0.004F;
constexpr float kOutside_m = 0.008F;

/// A camera that looks at the centre of a model, and the depth that it sees.
struct ViewImage {
  CameraPose T_camera_model;
  CameraIntrinsics intrinsics;
  /// Of a pixel at the centre.
  float pixel_m = 0.0F;
  Grid<float> depth_m;
};

Eigen::Matrix3f rotation_looking_along(Eigen::Vector3f const& forward) {
  Eigen::Vector3f const aside =
      std::abs(forward.z()) < 0.9F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  Eigen::Vector3f const right = forward.cross(aside).normalized();
  Eigen::Matrix3f rotation;
  rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return rotation;
}

ViewImage image_of(SearchModel const& model, Eigen::Vector3f const& to_camera) {
  ViewImage image;
  float const distance_m = kDistance_radii * model.radius_m;
  // The sphere that holds the model just fits.
  auto const focal_px = 0.5F * static_cast<float>(kViewSize_px - 4) *
                        std::sqrt(kDistance_radii * kDistance_radii - 1.0F);
  image.intrinsics = {focal_px, focal_px, kViewSize_px / 2.0, kViewSize_px / 2.0};
  image.pixel_m = distance_m / focal_px;
  image.T_camera_model.rotation = rotation_looking_along(-to_camera);
  image.T_camera_model.translation_m =
      Eigen::Vector3f(0, 0, distance_m) - image.T_camera_model.rotation * model.centre_model;
  DepthPatch const patch =
      model.rendered(image.T_camera_model, image.intrinsics, {kViewSize_px, kViewSize_px});
  image.depth_m = Grid<float>(kViewSize_px, kViewSize_px, kNoSurface_m);
  for (int v = 0; v < patch.depth_m.height(); ++v) {
    std::ranges::copy(patch.depth_m.row(v),
                      image.depth_m.row(v + patch.corner.v).begin() + patch.corner.u);
  }
  return image;
}

bool hit(ViewImage const& image, Pixel pixel) {
  return image.depth_m.contains(pixel) && image.depth_m[pixel] < kNoSurface_m;
}

Pixel pixel_of(ViewImage const& image, Eigen::Vector3f const& p_camera) {
  auto const focal_px = static_cast<float>(image.intrinsics.fx_px);
  auto const middle_px = static_cast<float>(image.intrinsics.cx_px);
  return {static_cast<int>(std::lround(focal_px * p_camera.x() / p_camera.z() + middle_px)),
          static_cast<int>(std::lround(focal_px * p_camera.y() / p_camera.z() + middle_px))};
}

std::vector<std::uint16_t> visible_points(SearchModel const& model, ViewImage const& image) {
  std::vector<std::uint16_t> visible;
  for (std::size_t i = 0; i < model.points_model.size(); ++i) {
    Eigen::Vector3f const p = image.T_camera_model * model.points_model[i];
    float const incidence =
        -(image.T_camera_model.rotation * model.normals_model[i]).dot(p.normalized());
    Pixel const pixel = pixel_of(image, p);
    if (incidence <= kLeastIncidence || !image.depth_m.contains(pixel)) {
      continue;
    }
    // A surface changes its depth within a pixel by its slope.
    float const tolerance_m = 1.5F * image.pixel_m / incidence;
    if (p.z() <= image.depth_m[pixel] + tolerance_m) {
      visible.push_back(static_cast<std::uint16_t>(i));
    }
  }
  return visible;
}

/// Unit, in the image, away from what the picture shows around a pixel.
Eigen::Vector2f outward(ViewImage const& image, Pixel pixel) {
  constexpr int kReach_px = 3;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (int dv = -kReach_px; dv <= kReach_px; ++dv) {
    for (int du = -kReach_px; du <= kReach_px; ++du) {
      if (!hit(image, {pixel.u + du, pixel.v + dv})) {
        sum += Eigen::Vector2f(static_cast<float>(du), static_cast<float>(dv));
      }
    }
  }
  return sum.squaredNorm() > 0.0F ? Eigen::Vector2f(sum.normalized()) : sum;
}

std::vector<Pixel> border_of(ViewImage const& image) {
  std::vector<Pixel> border;
  for (int v = 0; v < kViewSize_px; ++v) {
    for (int u = 0; u < kViewSize_px; ++u) {
      bool const inside = hit(image, {u, v});
      if (inside && !(hit(image, {u - 1, v}) && hit(image, {u + 1, v}) && hit(image, {u, v - 1}) &&
                      hit(image, {u, v + 1}))) {
        border.push_back({u, v});
      }
    }
  }
  return border;
}

/// The model's point that a pixel shows at a depth.
Eigen::Vector3f model_point(ViewImage const& image, Eigen::Vector2f const& pixel, float depth_m) {
  auto const focal_px = static_cast<float>(image.intrinsics.fx_px);
  auto const middle_px = static_cast<float>(image.intrinsics.cx_px);
  Eigen::Vector3f const p_camera((pixel.x() - middle_px) * depth_m / focal_px,
                                 (pixel.y() - middle_px) * depth_m / focal_px, depth_m);
  return image.T_camera_model.rotation.transpose() *
         (p_camera - image.T_camera_model.translation_m);
}

std::optional<OutlinePair> pair_at(ViewImage const& image, Pixel border) {
  Eigen::Vector2f const at(static_cast<float>(border.u), static_cast<float>(border.v));
  Eigen::Vector2f const out = outward(image, border);
  float const inside_px = std::max(1.0F, kInside_m / image.pixel_m);
  Eigen::Vector2f const inside = at - out * inside_px;
  Eigen::Vector2f const outside = at + out * std::max(2.0F, kOutside_m / image.pixel_m);
  auto const rounded = [](Eigen::Vector2f const& p) {
    return Pixel{static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
  };
  Pixel const in = rounded(inside);
  if (!hit(image, in) || hit(image, rounded(outside))) {
    return std::nullopt;
  }
  return OutlinePair{model_point(image, inside, image.depth_m[in]),
                     model_point(image, outside, image.depth_m[in]),
                     // The border's own pixel is inside as well.
                     (inside_px + 0.5F) * image.pixel_m};
}

std::vector<OutlinePair> outline_of(ViewImage const& image) {
  std::vector<Pixel> const border = border_of(image);
  std::vector<OutlinePair> outline;
  std::size_t const count = std::min(kMaxOutline, border.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (auto const pair = pair_at(image, border[i * border.size() / count])) {
      outline.push_back(*pair);
    }
  }
  return outline;
}

}  // namespace

std::vector<ModelView> views_of(SearchModel const& model) {
  std::vector<ModelView> views;
  for (Eigen::Vector3f const& direction : view_directions()) {
    ViewImage const image = image_of(model, direction);
    auto const shown =
        std::ranges::count_if(image.depth_m, [](float depth_m) { return depth_m < kNoSurface_m; });
    ModelView view;
    view.to_camera_model = direction;
    view.visible = visible_points(model, image);
    view.area_m2 = static_cast<float>(shown) * image.pixel_m * image.pixel_m;
    view.outline = outline_of(image);
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace credo
