#include "detector/detection_picture.hpp"

#include <cstddef>

#include "detector/poses/camera_pose.hpp"
#include "geometry/depth_patch.hpp"
#include "io/palette.hpp"

namespace credo {
namespace {

constexpr double kTint = 0.35;
/// A model's surface shows unless the scene is so much nearer.
constexpr float kBehind_m = 0.03F;

bool on_silhouette(DepthPatch const& patch, Pixel p) {
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      Pixel const q{p.u + du, p.v + dv};
      if (!patch.depth_m.contains(q) || patch.depth_m[q] == kNoSurface_m) {
        return true;
      }
    }
  }
  return false;
}

void draw(Grid<Rgb>& picture, Frame const& frame, DepthPatch const& patch, Rgb color) {
  for (int v = 0; v < patch.depth_m.height(); ++v) {
    for (int u = 0; u < patch.depth_m.width(); ++u) {
      float const depth_m = patch.depth_m[{u, v}];
      if (depth_m == kNoSurface_m) {
        continue;
      }
      Pixel const at{u + patch.corner.u, v + patch.corner.v};
      float const seen_m = frame.cloud_camera.z[at];
      bool const hidden = seen_m > 0.0F && seen_m < depth_m - kBehind_m;
      if (on_silhouette(patch, {u, v})) {
        picture[at] = mixed(picture[at], color, hidden ? 0.5 : 1.0);
      } else if (!hidden) {
        picture[at] = mixed(picture[at], color, kTint);
      }
    }
  }
}

}  // namespace

Grid<Rgb> draw_detections(Frame const& frame, PreparedModels const& models,
                          std::vector<Detection> const& detections) {
  Grid<float> const& depth_m = frame.cloud_camera.z;
  Grid<Rgb> picture(depth_m.width(), depth_m.height());
  bool const in_color = frame.color_registered && frame.color.same_size(depth_m);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    picture[i] = in_color ? frame.color[i] : depth_grey(depth_m[i]);
  }
  for (std::size_t d = 0; d < detections.size(); ++d) {
    auto const found = models.find(detections[d].type);
    if (found == models.end()) {
      continue;
    }
    SearchModel const& model = found->second->model;
    DepthPatch const patch = model.rendered(camera_pose(detections[d].pose_camera.mean),
                                            frame.intrinsics, {depth_m.width(), depth_m.height()});
    draw(picture, frame, patch, object_color(d, 1.0));
  }
  return picture;
}

}  // namespace credo
